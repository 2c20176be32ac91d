// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_readers_h
#define corotet_mesh_mesh_readers_h

#include <corotet/mesh/gmsh_model.h>

#include <string>

/**
 * Readers of mesh formats that gmsh reads incompletely. All functions throw
 * InputError that names the file and, in text, the line, and MachineError if
 * the file cannot be read.
 */
namespace corotet
{
  /// Reads gmsh's files of version 2, text or binary. There each element has
  /// its own physical group, whatever its entity is. @p zero_is_group: a first
  /// tag of 0 is a group like others, and elements without a group have no
  /// tags. Errors blame @p origin, or the file if that is empty.
  GmshModel
  read_msh_2(const std::string &path,
             const bool         zero_is_group = false,
             const std::string &origin        = "");

  /// Reads Nastran's bulk data: GRID, CTETRA and CTRIA in all formats of
  /// fields. The numbers of properties become groups. Other data are left out,
  /// except for other solids and coordinate systems of nodes, which are
  /// refused.
  GmshModel
  read_nastran(const std::string &path);

  /// Reads universal files of I-deas: nodes, elements, groups of elements.
  /// Elements without a group get the number of their material or, if all of
  /// this dimension have the same one, of their physical property.
  GmshModel
  read_unv(const std::string &path);

  /// Reads text files of Medit: vertices, triangles and tetrahedra of degree 1
  /// and 2. References become groups. Other data are left out, except for other
  /// cells, which are refused.
  GmshModel
  read_medit(const std::string &path);

  /// The unit of length of a STEP file if it is not millimetre, such as "inch".
  /// Empty if it is millimetre, or the file has none.
  std::string
  other_length_unit(const std::string &path);
} // namespace corotet

#endif
