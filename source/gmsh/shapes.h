// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_gmsh_shapes_h
#define corotet_gmsh_shapes_h

#include <corotet/mesh/gmsh_model.h>

namespace corotet::gmsh_program
{
  /**
   * Lets gmsh, which has been initialised, read the solids of a file of a CAD
   * program: solids that touch share the faces where they do. Returns the
   * groups of solids by their names in the file, and of surfaces by their
   * colours, "colour-ff8000"; others are called "solid N" and "surface N", by
   * gmsh's numbers. Without solids, surfaces are sewn to some, which @p remark
   * tells. Throws what gmsh throws, and std::runtime_error if these do not
   * close either.
   */
  std::vector<GmshModel::Group>
  read_shapes(const GmshRequest &request, std::string &remark);
} // namespace corotet::gmsh_program

#endif
