// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_effective_operator_h
#define corotet_operators_effective_operator_h

#include <corotet/base/vector.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/mass.h>

#include <deal.II/lac/trilinos_sparse_matrix.h>

#include <cstdint>
#include <vector>

namespace corotet
{
  /**
   * The linear operator of implicit steps, A = c_K K + c_M M, with the frozen
   * rotations that the elasticity has at the moment of update(). Rows and
   * columns of prescribed unknowns are those of a diagonal matrix, so A is
   * symmetric and positive definite if c_M > 0 or enough is prescribed.
   *
   * A is assembled. The sparsity and the place of every block of every cell in
   * it are found once; update() writes numbers only. Each rank computes its own
   * rows from all cells that touch them, ghost cells included, so assembly
   * needs no communication.
   *
   * The arguments of the constructor must outlive this object.
   */
  class EffectiveOperator
  {
  public:
    /// @p is_prescribed: for each local unknown, ghosts included. Collective.
    EffectiveOperator(const Discretization             &discretization,
                      const ReferenceElement           &reference,
                      const Elasticity                 &elasticity,
                      const Mass                       &mass,
                      const std::vector<unsigned char> &is_prescribed);

    /// Takes the rotations and the coefficients. Not collective.
    void
    update(const double c_K, const double c_M);

    /// dst = A src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const
    {
      sparse_matrix.vmult(dst, src);
    }

    const dealii::TrilinosWrappers::SparseMatrix &
    matrix() const
    {
      return sparse_matrix;
    }

    const Discretization &
    discretization() const
    {
      return disc;
    }

    const std::vector<unsigned char> &
    is_prescribed() const
    {
      return prescribed;
    }

    /// c_M / c_K of the last update [1/s^2]: 0 in statics.
    double
    mass_ratio() const
    {
      return ratio;
    }

  private:
    void
    make_sparsity();
    void
    locate_blocks();
    template <int p>
    void
    add_cell(const unsigned int cell, const double c_K, const double c_M);

    const Discretization             &disc;
    const ReferenceElement           &reference;
    const Elasticity                 &elasticity;
    const Mass                       &mass;
    const std::vector<unsigned char> &prescribed;
    double                            ratio = 0;

    dealii::TrilinosWrappers::SparseMatrix sparse_matrix;
    /// First value of each owned row.
    std::vector<double *> row_values;
    std::vector<int>      row_lengths;
    /// Position in the row of the diagonal entry of each owned row.
    std::vector<std::uint16_t> diagonal_positions;
    /// [local cell][row node i][column node j]: position of the first of the
    /// block's three columns in each of its three rows.
    std::vector<std::uint16_t> block_positions;
    /// Local cells with prescribed unknowns.
    std::vector<unsigned char> touches_prescribed;
  };
} // namespace corotet

#endif
