// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_cellwise_operator_h
#define corotet_operators_cellwise_operator_h

#include <corotet/operators/cell_loop.h>
#include <corotet/operators/surface_matrix.h>
#include <corotet/operators/sweep.h>

#include <vector>

namespace corotet
{
  /**
   * The operator A = c_K K + c_M M of one element, plus a matrix of the surface
   * if there is one, applied cell by cell without a matrix in numbers of type
   * T. Rows and columns of prescribed unknowns are those of a diagonal matrix.
   *
   * Vectors are those of the nodes. Ghost entries of sources are brought up to
   * date where they are not in use, and left as they came. All objects that the
   * constructor and set_*() get by reference or pointer must outlive this
   * object. Members but those marked are collective.
   */
  template <typename T>
  class CellwiseOperator
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<T>;

    /// @p prescribed has the prescribed local unknowns, with ghosts.
    CellwiseOperator(const Nodes &nodes, std::vector<unsigned int> prescribed);

    /**
     * Sets A = c_K K + c_M M with c_K > 0. If @p lumped_mass is given, it is
     * the diagonal of M; otherwise M is the consistent mass of @p masses. Not
     * collective.
     */
    void
    set_terms(const double               c_K,
              const CellCoefficients<T> *coefficients,
              const double               c_M,
              const CellMasses<T>       *masses,
              const VectorType          *lumped_mass);

    /// Adds the matrix to A; removes it if @p surface is null. Not collective.
    void
    set_surface(const SurfaceOperator<T> *surface);

    /// Computes the diagonal of A without that of the surface's matrix. To be
    /// called after set_*() if any of the following members is used.
    void
    compute_diagonal();

    /// What compute_diagonal() has found, to which a derived class may add;
    /// empty before.
    const VectorType &
    diagonal() const
    {
      return diagonal_of_A;
    }

    /// dst = A src; before compute_diagonal() dst is zero at prescribed
    /// unknowns.
    void
    vmult(VectorType &dst, const VectorType &src) const;

    /// r = b - A x, zero at prescribed unknowns, where x must be zero.
    void
    residual(VectorType &r, const VectorType &b, const VectorType &x) const;

    /**
     * d = beta d + alpha D^{-1} (b - A x), then x += d, in one sweep. Where
     * @p inverse_diagonal is zero, x must be zero and does not change.
     */
    void
    chebyshev_step(VectorType       &x,
                   VectorType       &d,
                   const VectorType &b,
                   const VectorType &inverse_diagonal,
                   const T           beta,
                   const T           alpha) const;

    const Nodes &
    nodes() const
    {
      return cell_loop.get_nodes();
    }

    /// The prescribed local unknowns, with ghosts.
    const std::vector<unsigned int> &
    prescribed_unknowns() const
    {
      return prescribed;
    }

  protected:
    /// The diagonal; derived classes may add to it.
    VectorType diagonal_of_A;

  private:
    template <typename Store>
    void
    apply(const VectorType &src, const Store &store) const;

    CellLoop<T>               cell_loop;
    std::vector<unsigned int> prescribed;
    mutable std::vector<T>    saved;

    FormData<T>       data;
    FormSweep<T>      sweep;
    FormSweep<T>      diagonal_sweep;
    T                 scale       = 0;
    T                 lumped      = 0;
    T                 unit        = 0;
    const VectorType *lumped_mass = nullptr;

    const SurfaceOperator<T> *surface = nullptr;
    /// The product of the surface's matrix and the source during an
    /// application, else zero.
    mutable VectorType surface_product;
  };
} // namespace corotet

#endif
