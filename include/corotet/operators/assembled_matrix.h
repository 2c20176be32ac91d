// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_assembled_matrix_h
#define corotet_operators_assembled_matrix_h

#include <corotet/base/vector.h>
#include <corotet/discretization/nodes.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/operators/block_matrix.h>
#include <corotet/operators/factored_kernel.h>
#include <corotet/operators/surface_matrix.h>

#include <deal.II/base/aligned_vector.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace corotet
{
  /// The pattern of matrices with blocks for all pairs of @p nodes that share a
  /// cell. Throws ComputationError if there are too many for one rank.
  /// Collective.
  std::shared_ptr<const BlockPattern>
  block_pattern(const Nodes &nodes);

  /**
   * The places of the cells' blocks in a matrix of that pattern. Almost all
   * rows have at most 256 blocks: then a place takes one byte.
   */
  class BlockPlaces
  {
  public:
    BlockPlaces() = default;

    /// Not collective.
    BlockPlaces(const Nodes &nodes, const BlockPattern &pattern);

    /// The place of the block in its row, by [local cell][row node i][column
    /// node j]; without meaning for rows of other ranks.
    unsigned int
    operator[](const std::size_t i) const
    {
      return high.empty() ? low[i] : 256u * high[i] + low[i];
    }

  private:
    std::vector<std::uint8_t> low;
    /// Multiples of 256 in the places; empty if there are none.
    std::vector<std::uint8_t> high;
  };

  /**
   * The matrix A = c_K K + c_M M of one element, plus a matrix of the surface
   * if there is one. Rows and columns of prescribed unknowns are those of a
   * diagonal matrix.
   *
   * The pattern and the places of all blocks of all cells are found once;
   * update() only writes values. Each rank computes its own rows from all cells
   * that touch them, with ghost cells, so assembly needs no communication.
   *
   * @p nodes must outlive this object.
   */
  class AssembledMatrix
  {
  public:
    /// @p is_prescribed has an entry for each local unknown, with ghosts.
    /// @p pattern is that of @p nodes, or one with more blocks, for values that
    /// are added to matrix().
    AssembledMatrix(const Nodes                               &nodes,
                    const std::vector<unsigned char>          &is_prescribed,
                    const std::shared_ptr<const BlockPattern> &pattern);

    /// Computes the A that CellwiseOperator::set_terms() defines, from the
    /// coefficients of all local cells, and adds the matrix of the surface, if
    /// that is not null. Not collective.
    void
    update(const double                                           c_K,
           const dealii::AlignedVector<CellCoefficients<double>> &coefficients,
           const double                                           c_M,
           const dealii::AlignedVector<CellMasses<double>>       &masses,
           const Vector                                          *lumped_mass,
           const SurfaceOperator<double> *surface = nullptr);

    /// Computes A from the symmetric parts of the matrices of all local cells,
    /// which @p hand_over passes on as to an Elasticity::TakeCellMatrices.
    void
    update(const std::function<void(
             const std::function<void(const unsigned int, const double *)> &)>
                                         &hand_over,
           const double                   c_M,
           const Vector                  *lumped_mass,
           const SurfaceOperator<double> *surface);

    /// The matrix; it has no values after release_values().
    const BlockMatrix &
    matrix() const
    {
      return *block_matrix;
    }

    /// Gives back the memory of the values until the next update(). Not
    /// collective.
    void
    release_values()
    {
      block_matrix->release_values();
    }

    /// The matrix, to which values may be added.
    BlockMatrix &
    matrix()
    {
      return *block_matrix;
    }

  private:
    /// Adds the contributions that do not come from cells.
    void
    add_others(const double                   c_M,
               const Vector                  *lumped_mass,
               const SurfaceOperator<double> *surface);
    /// Adds block i, j of cells [first, first + n_cells) and its transpose.
    void
    add_lanes(const unsigned int first,
              const unsigned int n_cells,
              const unsigned int i,
              const unsigned int j,
              const Simd<double> (&K)[3][3]);
    /// Adds block i, j of a cell and its transpose; @p block is overwritten.
    void
    add_block(const unsigned int cell,
              const unsigned int i,
              const unsigned int j,
              double (&block)[3][3]);

    const Nodes                     &nodes;
    const ReferenceElement          &reference;
    const std::vector<unsigned char> prescribed;

    std::unique_ptr<BlockMatrix> block_matrix;
    BlockPlaces                  places_of_blocks;
    /// Whether each local cell has prescribed unknowns.
    std::vector<unsigned char> touches_prescribed;
  };
} // namespace corotet

#endif
