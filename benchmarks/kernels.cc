// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Operations on cells, with data that stay in the first-level cache.

#include <corotet/material/polar_decomposition_simd.h>
#include <corotet/operators/quadrature_kernel.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <vector>

#include "flops.h"
#include "measure.h"
#include "svd_rotation.h"

namespace corotet::benchmarks
{
  namespace
  {
    constexpr unsigned int n_cells = 256;

    using Gradients = std::vector<dealii::Tensor<2, 3>>;

    /// Random rotations by any angle, times stretches of some ten percent.
    Gradients
    deformation_gradients()
    {
      Gradients result(n_cells);
      for (unsigned int n = 0; n < n_cells; ++n)
        {
          const double         angle = 0.1 * n;
          dealii::Tensor<2, 3> R, S;
          R[0][0] = R[1][1] = std::cos(angle);
          R[1][0]           = std::sin(angle);
          R[0][1]           = -R[1][0];
          R[2][2]           = 1;
          for (unsigned int a = 0; a < 3; ++a)
            for (unsigned int b = a; b < 3; ++b)
              S[a][b] = S[b][a] =
                (a == b ? 1 : 0) + 0.1 * std::sin(n + 3. * a + b);
          result[n] = R * S;
        }
      return result;
    }

    /// n registers of cells whose data stay in the first-level cache.
    template <typename Kernel>
    struct Cells
    {
      static constexpr unsigned int n = 48 / Kernel::n_nodes;

      Cells()
        : u(n)
        , v(n)
      {
        for (unsigned int cell = 0; cell < n; ++cell)
          for (int i = 0; i < Kernel::n_nodes; ++i)
            for (int a = 0; a < 3; ++a)
              u[cell].values[i][a] =
                typename Kernel::V{} + std::sin(3.f * i + a + cell);
      }

      struct alignas(64) Values
      {
        typename Kernel::NodalValues values;
      };

      dealii::AlignedVector<Values> u;
      dealii::AlignedVector<Values> v;
    };

    template <int p, typename T, bool with_mass>
    struct FactoredCells : Cells<FactoredKernel<p, T>>
    {
      using Kernel = FactoredKernel<p, T>;

      FactoredCells()
        : coefficients(this->n)
      {
        for (auto &cell : coefficients)
          for (int lane = 0; lane < n_lanes<T>; ++lane)
            {
              for (int i = 0; i < 9; ++i)
                cell.gradients[i][lane] = std::cos(i + lane);
              cell.lame_ratio[lane] = 1.5;
            }
      }

      __attribute__((flatten, noinline)) void
      apply()
      {
        for (unsigned int cell = 0; cell < this->n; ++cell)
          {
            typename Kernel::NodalValues u, v;
            static_for<Kernel::n_nodes>([&](auto i) {
              static_for<3>(
                [&](auto a) { u[i][a] = this->u[cell].values[i][a]; });
            });
            Kernel::template apply<true, with_mass>(
              &coefficients[cell], broadcast(T(2)), nullptr, u, v);
            static_for<Kernel::n_nodes>([&](auto i) {
              static_for<3>(
                [&](auto a) { this->v[cell].values[i][a] = v[i][a]; });
            });
          }
      }

      dealii::AlignedVector<CellCoefficients<T>> coefficients;
    };

    template <int p>
    struct QuadratureCells : Cells<QuadratureKernel<bernstein::size<p>>>
    {
      using Kernel = QuadratureKernel<bernstein::size<p>>;
      using V      = typename Kernel::V;

      /// The rotations of a register of cells: [3 row + column][lane].
      struct alignas(sizeof(V)) Rotations
      {
        double rotation[9][batch_size];
      };

      QuadratureCells()
        : reference(p)
        , constants(this->n)
        , at_rest(this->n)
        , rotations(this->n)
      {
        for (unsigned int cell = 0; cell < this->n; ++cell)
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            {
              for (unsigned int i = 0; i < 9; ++i)
                {
                  at_rest[cell].inverse_jacobian[i][lane] = std::cos(i + lane);
                  rotations[cell].rotation[i][lane]       = i % 4 == 0;
                }
              constants[cell].volume[lane] = 1;
              constants[cell].scale[lane]  = 1;
            }
      }

      __attribute__((flatten, noinline)) void
      apply()
      {
        for (unsigned int cell = 0; cell < this->n; ++cell)
          {
            typename Kernel::NodalValues u, f{};
            static_for<Kernel::n_nodes>([&](auto i) {
              static_for<3>(
                [&](auto a) { u[i][a] = this->u[cell].values[i][a]; });
            });
            V R[3][3];
            static_for<9>([&](auto i) {
              R[i / 3][i % 3] =
                load_aligned<batch_size>(rotations[cell].rotation[i]);
            });
            const V scale  = load_aligned<batch_size>(constants[cell].scale);
            const V volume = load_aligned<batch_size>(constants[cell].volume);
            const V mu     = scale * scale / volume;
            const V lambda = 1.5 * mu;
            typename Kernel::Geometry g;
            static_for<9>(
              [&](auto i) { g[i] = lanes(at_rest[cell].inverse_jacobian[i]); });
            Kernel::integrate(reference.stiffness_rule,
                              g,
                              volume,
                              u,
                              f,
                              [&](const unsigned int,
                                  const V(&grad_u)[3][3],
                                  V(&P)[3][3]) {
                                corotational_tangent(R, lambda, mu, grad_u, P);
                              });
            static_for<Kernel::n_nodes>([&](auto i) {
              static_for<3>(
                [&](auto a) { this->v[cell].values[i][a] = f[i][a]; });
            });
          }
      }

      const ReferenceElement                    reference;
      dealii::AlignedVector<CellConstants>      constants;
      dealii::AlignedVector<CellGeometryAtRest> at_rest;
      dealii::AlignedVector<Rotations>          rotations;
    };

    template <typename CellsType>
    void
    add_kernel(const std::string &name, const double flops, const int lanes)
    {
      add_short("kernels/" + name, [=] {
        const auto   cells = std::make_shared<CellsType>();
        const double n     = lanes * CellsType::n;
        return Measured{[cells] {
                          cells->apply();
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n}, {"flops", n * flops}}};
      });
    }

    template <int p>
    void
    add_kernels_of_degree()
    {
      const std::string name = fmt::format("P{}_", p);
      const double      K    = factored_flops<p, true, false>();
      const double      both = factored_flops<p, true, true>();
      add_kernel<FactoredCells<p, double, false>>(name + "double",
                                                  K,
                                                  n_lanes<double>);
      add_kernel<FactoredCells<p, double, true>>(name + "double_mass",
                                                 both,
                                                 n_lanes<double>);
      add_kernel<FactoredCells<p, float, false>>(name + "float",
                                                 K,
                                                 n_lanes<float>);
      add_kernel<FactoredCells<p, float, true>>(name + "float_mass",
                                                both,
                                                n_lanes<float>);
      add_kernel<QuadratureCells<p>>(
        name + "quadrature",
        quadrature_flops<p>(ReferenceElement(p).stiffness_rule.weights.size()),
        n_lanes<double>);
    }

    /// Adds the decomposition of all lanes at once.
    void
    add_polar_decomposition_simd()
    {
      struct alignas(64) Matrix
      {
        Simd<double> F[3][3];
      };
      add_short("kernels/polar_decomposition_simd", [] {
        constexpr unsigned int n = n_cells / n_lanes<double>;
        const auto      F = std::make_shared<dealii::AlignedVector<Matrix>>(n);
        const auto      R = std::make_shared<dealii::AlignedVector<Matrix>>(n);
        const Gradients gradients = deformation_gradients();
        for (unsigned int c = 0; c < n * n_lanes<double>; ++c)
          for (unsigned int i = 0; i < 9; ++i)
            (*F)[c / n_lanes<double>].F[i / 3][i % 3][c % n_lanes<double>] =
              gradients[c][i / 3][i % 3];
        return Measured{[F, R] {
                          for (unsigned int i = 0; i < F->size(); ++i)
                            polar_decomposition((*F)[i].F, (*R)[i].F);
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n_cells}}};
      });
    }

    void
    add_polar_decomposition()
    {
      add_short("kernels/polar_decomposition", [] {
        const auto F = std::make_shared<Gradients>(deformation_gradients());
        const auto R = std::make_shared<Gradients>(n_cells);
        return Measured{[F, R] {
                          for (unsigned int n = 0; n < n_cells; ++n)
                            (*R)[n] = polar_decomposition((*F)[n]).rotation;
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n_cells}}};
      });
    }

    void
    add_jacobi_svd()
    {
      using Matrix = Eigen::Matrix3d;
      add_short("kernels/jacobi_svd", [] {
        const auto F = std::make_shared<std::vector<Matrix>>();
        const auto R = std::make_shared<std::vector<Matrix>>(n_cells);
        for (const auto &f : deformation_gradients())
          {
            const Matrix matrix{{f[0][0], f[0][1], f[0][2]},
                                {f[1][0], f[1][1], f[1][2]},
                                {f[2][0], f[2][1], f[2][2]}};
            F->push_back(matrix);
          }
        return Measured{[F, R] {
                          for (unsigned int n = 0; n < n_cells; ++n)
                            (*R)[n] = svd_rotation((*F)[n]);
                          benchmark::ClobberMemory();
                        },
                        {{"cells", n_cells}}};
      });
    }
  } // namespace
} // namespace corotet::benchmarks

int
main(int argc, char **argv)
{
  using namespace corotet::benchmarks;
  const Session session(argv);
  add_kernels_of_degree<1>();
  add_kernels_of_degree<2>();
  add_kernels_of_degree<3>();
  add_polar_decomposition_simd();
  add_polar_decomposition();
  add_jacobi_svd();
  return run(argc, argv);
}
