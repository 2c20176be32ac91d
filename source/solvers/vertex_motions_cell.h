// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_solvers_vertex_motions_cell_h
#define corotet_source_solvers_vertex_motions_cell_h

#include <corotet/solvers/vertex_motions.h>

namespace corotet
{
  /**
   * The matrix of a cell for the motions of its vertices. Lanes are cells of a
   * batch.
   */
  struct VertexMotions::CellMatrix
  {
    using V     = FrozenCellMatrices::V;
    using Block = FrozenCellMatrices::Block;

    // Stiffness and mass of the nodes of the quadratic element.
    Block K[10][10];
    V     mass[10][10];
    // The matrix of the vertices' motions.
    V A[4][4][6][6];
    // The edges at each vertex, and the motion of their middles by its
    // rotation.
    struct End
    {
      unsigned int edge;
      Block        X;
    };
    End ends[4][3];
    // The places of the vertices [m].
    V vertices[4][3];

    CellMatrix();

    void
    set_ends(const unsigned int                         edge,
             const unsigned int                         lane,
             const std::array<dealii::Tensor<1, 3>, 2> &arms);
    // The trace of the vertices' stiffness.
    V
    trace() const;
    V
    shear_stiffness(const V lame_ratio, V (&cofactors)[4][3]) const;
    void
    add_mass();
    void
    combine();
    void
    add_springs(const V      size,
                const double length,
                const V (&cofactors)[4][3],
                const V least);
  };
} // namespace corotet

#endif
