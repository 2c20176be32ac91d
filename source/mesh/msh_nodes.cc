// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "msh_nodes.h"

namespace corotet
{
  const std::vector<MshNode> line_nodes[]{{{0}, {1}},
                                          {{0}, {1}, {0, 1}},
                                          {{0}, {1}, {0, 0, 1}, {0, 1, 1}}};
  const std::vector<MshNode> triangle_nodes[]{
    {{0}, {1}, {2}},
    {{0}, {1}, {2}, {0, 1}, {1, 2}, {2, 0}},
    {{0},
     {1},
     {2},
     {0, 0, 1},
     {0, 1, 1},
     {1, 1, 2},
     {1, 2, 2},
     {2, 2, 0},
     {2, 0, 0},
     {0, 1, 2}}};
  const std::vector<MshNode> tetrahedron_nodes[]{
    {{0}, {1}, {2}, {3}},
    {{0}, {1}, {2}, {3}, {0, 1}, {1, 2}, {2, 0}, {3, 0}, {2, 3}, {1, 3}},
    {{0},       {1},       {2},       {3},       {0, 0, 1},
     {0, 1, 1}, {1, 1, 2}, {1, 2, 2}, {2, 2, 0}, {2, 0, 0},
     {3, 3, 0}, {3, 0, 0}, {3, 3, 2}, {3, 2, 2}, {3, 3, 1},
     {3, 1, 1}, {0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}}};
} // namespace corotet
