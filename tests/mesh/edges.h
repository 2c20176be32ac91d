// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_edges_h
#define corotet_tests_mesh_edges_h

#include <algorithm>

#include "../body.h"
#include "tools.h"

namespace corotet::tests
{
  /// Sum of the lengths of the edges that a name means.
  inline double
  edge_length(const SerialMesh &mesh, const std::string &name)
  {
    std::map<unsigned int, double> lengths;
    for (const auto &[ends, id] : mesh.edges)
      lengths[id] += mesh.vertices[ends[0]].distance(mesh.vertices[ends[1]]);
    return value_of(name, "edge", mesh.edge_names, lengths);
  }

  /// Positions of the vertices that a name means, in ascending order.
  inline std::vector<std::array<double, 3>>
  corner_places(const SerialMesh &mesh, const std::string &name)
  {
    const auto ids = MeshNames("corner", mesh.corner_names).ids(name, "");
    std::vector<std::array<double, 3>> result;
    for (const auto &[vertex, id] : mesh.corners)
      if (std::count(ids.begin(), ids.end(), id) > 0)
        result.push_back({{mesh.vertices[vertex][0],
                           mesh.vertices[vertex][1],
                           mesh.vertices[vertex][2]}});
    std::sort(result.begin(), result.end());
    return result;
  }

  /// The box [0, 2] x [0, 1] x [0, 1] of 8 x 4 x 4 cuboids.
  inline SerialMesh
  box_with(const std::string &edges,
           const std::string &corners    = "",
           const std::string &boundaries = "")
  {
    SelectionParameters parameters;
    parameters.edges      = edges;
    parameters.corners    = corners;
    parameters.boundaries = boundaries;
    return with_selections(tests::box("2, 1, 1", "8, 4, 4"), parameters);
  }
} // namespace corotet::tests

#endif
