// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_names_h
#define corotet_mesh_check_names_h

#include <corotet/mesh/edges.h>

namespace corotet
{
  /**
   * The part of check_mesh() that checks named faces, edges and corners: listed
   * faces must be faces of cells, and a face on the surface has one boundary.
   * Keeps the faces on the surface, the named edges that are edges of cells and
   * the corners that are vertices of cells, each once for each id; remarks
   * count the others. Returns the kept ones as parts of cells.
   */
  NamedParts
  check_names(SerialMesh &mesh);
} // namespace corotet

#endif
