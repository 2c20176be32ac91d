// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_mending_h
#define corotet_source_mesh_mending_h

#include <corotet/mesh/triangle_surface.h>

#include <string>

/// Parts of mend_surface().
namespace corotet::mending
{
  /// Throws the InputError that says @p message about the file of a surface.
  [[noreturn]] void
  refuse(const TriangleSurface &surface, const std::string &message);

  /// What numbers of seven digits, which is what files have, do not tell apart
  /// in the coordinates of a surface [m].
  double
  resolution(const TriangleSurface &surface);

  /**
   * A triangle whose corners lie on a line goes: the neighbour at its longest
   * edge is divided at the corner between the others, which changes no shape.
   * All edges must have two triangles. Returns how many have gone.
   */
  std::size_t
  divide_at_flat_triangles(TriangleSurface &surface);

  /// Throws an InputError if there are triangles whose corners lie on a line.
  void
  check_areas(const TriangleSurface &surface);
} // namespace corotet::mending

#endif
