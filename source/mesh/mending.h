// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_mending_h
#define corotet_source_mesh_mending_h

#include <corotet/mesh/triangle_surface.h>

#include <string>

/// Parts of mend_surface().
namespace corotet::mending
{
  /// Throws the InputError with @p message about the file of a surface.
  [[noreturn]] void
  refuse(const TriangleSurface &surface, const std::string &message);

  /// The accuracy of coordinates with seven digits, which files have, for the
  /// size of a surface [m].
  double
  resolution(const TriangleSurface &surface);

  /**
   * Removes triangles whose corners lie on a line: the neighbour at the longest
   * edge is divided at the opposite corner, which does not change the shape.
   * All edges must have two triangles. Returns the number of removed triangles.
   */
  std::size_t
  divide_at_flat_triangles(TriangleSurface &surface);

  /// Throws an InputError if there are triangles whose corners lie on a line.
  void
  check_areas(const TriangleSurface &surface);
} // namespace corotet::mending

#endif
