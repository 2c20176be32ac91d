// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_facets_h
#define corotet_mesh_facets_h

#include <corotet/mesh/serial_mesh.h>

#include <limits>
#include <set>
#include <string>

namespace corotet
{
  /// The id of surfaces that belong to no boundary.
  constexpr unsigned int no_boundary = std::numeric_limits<unsigned int>::max();

  /**
   * The boundaries (ids, or no_boundary) where the faces of straight cells look
   * like facets of a curved surface, of which nothing else is known.
   *
   * Triangles of a boundary that lie in one plane (within 0.1 degrees) and
   * share edges are a facet. A curved surface has facets that are one cell
   * wide: all their vertices lie where the surface bends. In a polyhedron such
   * facets are rare, and meet others at large angles. So a boundary is taken
   * for curved if at least four facets without a vertex inside them follow each
   * other, each turned by less than 42 degrees against the one before: a
   * cylinder has at least nine sides then.
   */
  std::set<unsigned int>
  faceted_boundaries(const SerialMesh &mesh);

  /// The remark for the log about straight cells along the curved boundaries
  /// with these ids.
  std::string
  remark_on_facets(const std::set<unsigned int> &boundaries,
                   const NamedSets              &named);

  /// Adds remark_on_facets() to a mesh, unless there are no such @p boundaries.
  void
  remark_facets(SerialMesh &mesh, const std::set<unsigned int> &boundaries);
} // namespace corotet

#endif
