// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_readers_h
#define corotet_mesh_mesh_readers_h

#include <corotet/mesh/gmsh_model.h>

#include <string>

/**
 * Meshes that we read ourselves, since gmsh leaves out some of what they say.
 * All functions throw InputError that names the file and, in text, the line,
 * and MachineError if the file cannot be read.
 */
namespace corotet
{
  /// gmsh's files of version 2, text or binary: there each element has its
  /// physical group, whatever its entity is. @p zero_is_group: a first tag of 0
  /// is a number like others, and elements of no group have no tags. Errors
  /// blame @p origin, or the file if that is empty.
  GmshModel
  read_msh_2(const std::string &path,
             const bool         zero_is_group = false,
             const std::string &origin        = "");

  /// Nastran's bulk data: GRID, CTETRA and CTRIA of all formats of fields. The
  /// numbers of properties are groups. What else is there is left out, but for
  /// other solids and coordinate systems of nodes, which are refused.
  GmshModel
  read_nastran(const std::string &path);

  /// Universal files of I-deas: nodes, elements, groups of elements. What is
  /// in no group has the number of its material or, if all of its dimension
  /// have the same, of its physical property.
  GmshModel
  read_unv(const std::string &path);

  /// Files of Medit, as text: vertices, triangles and tetrahedra of degree 1
  /// and 2. References are groups. What else is there is left out, but for
  /// other cells, which are refused.
  GmshModel
  read_medit(const std::string &path);

  /// The unit of length of a STEP file, if it is another one than millimetre:
  /// "inch". Empty if it is not, or the file has none.
  std::string
  other_length_unit(const std::string &path);
} // namespace corotet

#endif
