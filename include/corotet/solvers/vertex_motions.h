// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_vertex_motions_h
#define corotet_solvers_vertex_motions_h

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/discretization/discretization.h>
#include <corotet/operators/assembled_matrix.h>
#include <corotet/operators/block_matrix.h>
#include <corotet/operators/frozen_cell_matrices.h>
#include <corotet/operators/surface_matrix.h>
#include <corotet/solvers/aggregation_level.h>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * The quadratic functions that displacements and rotations of the vertices
   * define (as in the triangle of Allman 1984): the middle of an edge d from a
   * to b moves by
   *
   *   (u_a + u_b) / 2 + (w_a - w_b) x d / 8 + (w_a + w_b) x c / 2
   *
   * where c leads from the middle of the vertices to that of the edge; it is
   * zero on straight edges. So deflections of a thin body are quadratic, and
   * displacements across it follow their slope, where linear functions are too
   * stiff for thin cells by the square of their proportions. Rigid motions are
   * among these functions, on curved edges, too.
   *
   * The middle of a straight edge does not depend on rotations that are equal
   * at both ends. A weak spring ties the rotation of a vertex to that of the
   * cells around it.
   *
   * A vertex has six unknowns, its displacement and its rotation times a
   * length, as an aggregate in AggregationLevel: two nodes of a BlockMatrix.
   */
  class VertexMotions
  {
  public:
    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

    /// @p quadratic is the element of degree 2 without bubbles, whose vertices
    /// are @p vertices; @p is_prescribed refers to its local unknowns, with
    /// ghosts. All must outlive this object. Collective.
    VertexMotions(const Nodes                      &quadratic,
                  const CoarserNodes               &vertices,
                  const std::vector<unsigned char> &is_prescribed);

    /// Takes over the places of the nodes and the matrix A = c_K K + c_M M + S
    /// of the quadratic element for these functions. @p positions are those of
    /// the nodes of @p discretization, the finest element, with ghosts [m].
    /// Coefficients and masses are those that AssembledMatrix::update() takes;
    /// @p surface belongs to the quadratic element, and is null without S.
    /// Collective.
    void
    update(const Discretization &discretization,
           const Vector         &positions,
           const double          c_K,
           const dealii::AlignedVector<CellCoefficients<double>> &coefficients,
           const double                                           c_M,
           const dealii::AlignedVector<CellMasses<double>>       &masses,
           const SurfaceOperator<double>                         *surface);

    /// The matrix since the last update(). Prescribed displacements have a 1 on
    /// the diagonal.
    const BlockMatrix &
    matrix() const
    {
      return *problem.matrix;
    }

    /// The same matrix as a problem of aggregates.
    const AggregateProblem &
    aggregates() const
    {
      return problem;
    }

    /// x += P coarse; zero at prescribed unknowns, where x must be zero.
    /// @p coarse has six entries for each owned vertex. Collective.
    void
    prolongate_add(FloatVector &x, const float *coarse) const;

    /// coarse = P^T r, zero for prescribed displacements; @p r must be zero at
    /// prescribed unknowns. Collective.
    void
    restrict_to(float *coarse, const FloatVector &r) const;

  private:
    /// The matrices of a batch of cells.
    struct CellMatrix;

    /// The middle of an edge; rotations move it by w_a x arm_a + w_b x arm_b.
    struct Middle
    {
      unsigned int                        node;
      std::array<unsigned int, 2>         vertices;
      std::array<std::array<float, 3>, 2> arms;
    };

    void
    find_places(const Discretization &discretization, const Vector &positions);
    void
    make_matrix();
    std::array<dealii::Tensor<1, 3>, 2>
    arms(const dealii::Point<3> &a,
         const dealii::Point<3> &b,
         const dealii::Point<3> &middle) const;
    void
    set_arms();
    /// Gathers the places of the cells of a batch, from cell @p first on.
    void
    gather(const unsigned int first,
           const unsigned int n_cells,
           CellMatrix        &cells) const;
    void
    leave_out_prescribed(const unsigned int first,
                         const unsigned int n_cells,
                         CellMatrix        &cells) const;
    void
    add(const unsigned int first,
        const unsigned int n_cells,
        const CellMatrix  &cells);
    void
    add_surface(const SurfaceOperator<double> &surface, CellMatrix &cells);

    const Nodes                      &quadratic;
    const CoarserNodes               &vertices;
    const std::vector<unsigned char> &is_prescribed;
    const std::vector<unsigned char>  is_vertex_prescribed;

    /// Places of the local nodes of the quadratic element.
    std::vector<dealii::Point<3>> places;
    /// The length that rotations are multiplied with [m].
    double              length = 1;
    std::vector<Middle> middles;
    /// Whether each local cell has prescribed unknowns.
    std::vector<unsigned char> touches_prescribed;
    /// The pattern of vertices that share a cell, and the places of their
    /// blocks in it.
    std::shared_ptr<const BlockPattern> pattern;
    BlockPlaces                         places_of_blocks;
    AggregateProblem                    problem;

    mutable FloatVector displacements, rotations;
  };
} // namespace corotet

#endif
