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
   * Makes gmsh read a file of unconnected surfaces, as IGES files are, sew them
   * where their edges meet, and make the solids that they enclose, without the
   * hollows in them. The gaps that are allowed between edges are as small as
   * possible: next to none at first, at most a thousandth of the size of the
   * whole; @p remark tells the size. Returns the solids (dimension, number).
   * Throws std::runtime_error if surfaces do not close.
   */
  std::vector<std::pair<int, int>>
  sew_solids(const GmshRequest &request, std::string &remark);
} // namespace corotet::gmsh_program

#endif
