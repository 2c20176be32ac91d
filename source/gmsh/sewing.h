// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_gmsh_sewing_h
#define corotet_gmsh_sewing_h

#include <corotet/mesh/gmsh_model.h>

#include <string>
#include <utility>
#include <vector>

namespace corotet::gmsh_program
{
  /**
   * Lets gmsh read a file of surfaces that have nothing in common, as IGES
   * files are, sew them where their edges meet, and make the solids that they
   * enclose, with the hollows in these. Edges may have gaps between them, as
   * small ones as do: at first next to none, at most a thousandth of the size
   * of all, which @p remark tells. Returns the solids (dimension, number).
   * Throws std::runtime_error if surfaces do not close.
   */
  std::vector<std::pair<int, int>>
  sew_solids(const GmshRequest &request, std::string &remark);
} // namespace corotet::gmsh_program

#endif
