// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_surface_h
#define corotet_mesh_check_surface_h

#include <corotet/mesh/serial_mesh.h>

namespace corotet
{
  /// Vertices of a triangle.
  using Triangle = std::array<unsigned int, 3>;

  /**
   * Part of check_mesh(): throws an InputError if the triangles @p surface,
   * those of only one cell, touch each other elsewhere than in shared vertices
   * and edges.
   *
   * This finds every place where cells do not fit together. There are two
   * layers of surface there, and a vertex of one lies on a triangle of the
   * other or, at crossing diagonals, the centre of a triangle does.
   */
  void
  check_surface(const SerialMesh &mesh, const std::vector<Triangle> &surface);
} // namespace corotet

#endif
