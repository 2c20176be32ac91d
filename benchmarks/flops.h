// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_flops_h
#define corotet_benchmarks_flops_h

#include <corotet/base/simd.h>

#include <algorithm>
#include <iterator>

namespace corotet
{
  namespace benchmarks
  {
    /**
     * Numbers that count what is done with them: one for each addition,
     * subtraction and multiplication of a lane. Values are 0 or 1, where 1
     * means anything but a zero that the compiler knows: what is done with
     * such a zero does not count.
     */
    struct Counted
    {
      Counted() = default;

      template <typename Number>
      constexpr Counted(const Number value)
        : value(value != 0)
      {}

      double value;

      static inline double n_operations = 0;
    };

    struct alignas(64) CountedVector
    {
      Counted lanes[8];

      bool
      is_zero() const
      {
        return lanes[0].value == 0;
      }

      friend CountedVector
      operator+(const CountedVector &a, const CountedVector &b)
      {
        if (!a.is_zero() && !b.is_zero())
          Counted::n_operations += 1;
        return a.is_zero() ? b : a;
      }

      friend CountedVector
      operator-(const CountedVector &a, const CountedVector &b)
      {
        return a + b;
      }

      friend CountedVector
      operator*(const CountedVector &a, const CountedVector &b)
      {
        if (!a.is_zero() && !b.is_zero())
          Counted::n_operations += 1;
        return a.is_zero() ? a : b;
      }

      friend CountedVector
      operator*(const Counted a, const CountedVector &b)
      {
        return CountedVector{{a}} * b;
      }

      friend CountedVector
      operator*(const CountedVector &a, const Counted b)
      {
        return b * a;
      }

      CountedVector &
      operator+=(const CountedVector &b)
      {
        return *this = *this + b;
      }

      CountedVector &
      operator-=(const CountedVector &b)
      {
        return *this = *this - b;
      }
    };
  } // namespace benchmarks

  template <>
  inline constexpr int n_lanes<benchmarks::Counted> = 8;

  namespace internal
  {
    template <>
    struct VectorType<benchmarks::Counted, 8>
    {
      using type = benchmarks::CountedVector;
    };
  } // namespace internal
} // namespace corotet

#include <corotet/operators/factored_kernel.h>

namespace corotet::benchmarks
{
  /// The operations of the factored kernel for one cell, counted while it runs.
  template <int p, bool with_stiffness, bool with_mass>
  double
  factored_flops()
  {
    using Kernel = FactoredKernel<p, Counted>;
    CellCoefficients<Counted>    cell;
    typename Kernel::NodalValues u, v;
    const CountedVector          one{{1, 1, 1, 1, 1, 1, 1, 1}};
    for (auto &component : cell.gradients)
      for (auto &lane : component)
        lane = 1;
    for (auto &lane : cell.lame_ratio)
      lane = 1;
    for (auto &node : u)
      for (auto &value : node)
        value = one;
    Counted::n_operations = 0;
    Kernel::template apply<with_stiffness, with_mass>(
      &cell, one, nullptr, u, v);
    return Counted::n_operations;
  }

  /// The operations of the change to Bernstein's basis and of its transpose,
  /// for one component, counted while they run.
  template <int p>
  double
  basis_change_flops()
  {
    const CountedVector one{{1, 1, 1, 1, 1, 1, 1, 1}};
    CountedVector       u[bernstein::size<p>], v[bernstein::size<p>];
    std::fill(std::begin(u), std::end(u), one);
    std::fill(std::begin(v), std::end(v), one);
    Counted::n_operations = 0;
    BasisChange<p, Counted>::to_bernstein(u);
    BasisChange<p, Counted>::to_lagrange_transposed(v);
    return Counted::n_operations;
  }

  /**
   * Operations of the tangent by quadrature for one cell. Once, the form of
   * derivatives and its transpose: the change to Bernstein's basis and
   * differences. At each point the gradient by reference coordinates and its
   * transpose (each two for 9 n products, with n polynomials of degree p - 1),
   * the changes of coordinates (45 each), 10 for the weights, and the stress
   * (45 for R^T grad u, 3 for the trace, 21 for sigma, 45 for R sigma).
   */
  template <int p>
  double
  quadrature_flops(const int n_points)
  {
    constexpr int n = bernstein::size<p - 1>;
    return 3 * basis_change_flops<p>() + 3 * 9 * n +
           n_points * (36. * n + 2 * 45 + 10 + 45 + 3 + 21 + 45);
  }
} // namespace corotet::benchmarks

#endif
