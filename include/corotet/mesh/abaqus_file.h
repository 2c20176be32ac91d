// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_abaqus_file_h
#define corotet_mesh_abaqus_file_h

#include <corotet/mesh/imported_mesh.h>

namespace corotet
{
  /**
   * Reads the mesh of an input file of Abaqus or CalculiX (.inp): *NODE,
   * *ELEMENT with tetrahedra (C3D4, C3D10 and their variants), *ELSET and *NSET
   * (also GENERATE and sets of sets), *SURFACE of element faces or of nodes,
   * *INCLUDE, and INPUT= of data, where included files are in the folder of the
   * first file or below it. The file may be flat or have *PART, *ASSEMBLY and
   * *INSTANCE (moved and turned). Keywords and names may be in any case, and
   * lines are continued after a comma.
   *
   * Sets of tetrahedra and of nodes and surfaces keep their names; triangles
   * and lines among the elements give theirs to faces and nodes. A name that
   * several instances have is preceded by the instance's name and a dot.
   * Everything that is not part of the mesh (materials, steps) is left out with
   * a remark.
   *
   * Throws InputError with file and line, and MachineError if a file cannot be
   * read.
   */
  ImportedMesh
  read_abaqus_file(const std::string &path);
} // namespace corotet

#endif
