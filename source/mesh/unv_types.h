// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_unv_types_h
#define corotet_source_mesh_unv_types_h

#include <cstdint>
#include <optional>
#include <set>
#include <vector>

namespace corotet
{
  /// gmsh's type of elements, and the nodes in gmsh's order.
  struct UnvType
  {
    int              gmsh;
    std::vector<int> order;
  };



  /// The type for I-deas's number of a type and number of nodes. I-deas puts
  /// nodes on edges between the corners.
  inline std::optional<UnvType>
  unv_type(const std::int64_t number, const std::int64_t n_nodes)
  {
    static const std::set<std::int64_t> lines{11, 21, 22, 23, 24, 31, 32},
      triangles{41, 42, 51, 52, 61, 62, 72, 74, 81, 82, 91, 92};
    if (number == 111 && n_nodes == 4)
      return UnvType{4, {0, 1, 2, 3}};
    if (number == 118 && n_nodes == 10)
      return UnvType{11, {0, 2, 4, 9, 1, 3, 5, 6, 8, 7}};
    if (triangles.contains(number) && n_nodes == 3)
      return UnvType{2, {0, 1, 2}};
    if (triangles.contains(number) && n_nodes == 6)
      return UnvType{9, {0, 2, 4, 1, 3, 5}};
    if (lines.contains(number) && n_nodes == 2)
      return UnvType{1, {0, 1}};
    if (lines.contains(number) && n_nodes == 3)
      return UnvType{8, {0, 2, 1}};
    return {};
  }
} // namespace corotet

#endif
