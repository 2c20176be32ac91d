// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_dilatation_h
#define corotet_material_dilatation_h

#include <corotet/base/enumeration.h>
#include <corotet/material/material_law.h>

namespace corotet
{
  /**
   * The dilatation that elements of degree 1 resist.
   */
  enum class Dilatation
  {
    /// The dilatation of each cell, which locks in nearly incompressible
    /// bodies.
    cells,
    /// The mean dilatation of the cells around each vertex, see
    /// VertexDilatation.
    vertices
  };

  inline const Enumeration<Dilatation> dilatations{{"cells", Dilatation::cells},
                                                   {"vertices",
                                                    Dilatation::vertices}};

  /// Whether elements of degree 1 with this law may have the dilatation of
  /// vertices: whether the law is linear, or corotational with the rotations of
  /// cells.
  inline bool
  allows_vertex_dilatation(const MaterialLaw &law)
  {
    return law.is_linear() || law.has_cell_rotation();
  }
} // namespace corotet

#endif
