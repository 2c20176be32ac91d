// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_gmsh_med_h
#define corotet_source_gmsh_med_h

#include <corotet/mesh/gmsh_model.h>

#include <string>

namespace corotet::gmsh_program
{
  /**
   * Reads the mesh in a MED file (Salome, code_aster) by MED's own library:
   * families become entities, and groups of cells, faces, edges and nodes
   * become groups of volumes, surfaces, curves and points. Throws
   * std::runtime_error, also if corotet was built without that library.
   */
  GmshModel
  read_med(const std::string &path);
} // namespace corotet::gmsh_program

#endif
