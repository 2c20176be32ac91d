// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_gmsh_shapes_h
#define corotet_gmsh_shapes_h

#include <corotet/mesh/gmsh_model.h>

namespace corotet::gmsh_program
{
  /**
   * Makes gmsh, which must be initialised, read the solids of a file of a CAD
   * program: solids that touch share the faces where they do. Returns the
   * groups of solids by their names in the file, and of surfaces by their
   * colours, "colour-ff8000"; others are called "solid N" and "surface N", with
   * gmsh's numbers. If the file has no solids, its surfaces are sewn to solids,
   * which @p remark tells. Throws what gmsh throws, and std::runtime_error if
   * the surfaces do not close.
   */
  std::vector<GmshModel::Group>
  read_shapes(const GmshRequest &request, std::string &remark);
} // namespace corotet::gmsh_program

#endif
