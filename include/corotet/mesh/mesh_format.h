// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_format_h
#define corotet_mesh_mesh_format_h

#include <string>
#include <vector>

namespace corotet
{
  /// The formats of files that a mesh can come from.
  enum class MeshFormat
  {
    abaqus,
    brep,
    cgns,
    corotet,
    geo,
    iges,
    med,
    medit,
    msh,
    nastran,
    obj,
    off,
    ply,
    step,
    stl,
    unv,
    vtk
  };

  struct MeshFormatDescription
  {
    MeshFormat format;
    /// As programs know it, in lower case: "step".
    std::string name;
    /// Usual ends of file names: ".step, .stp". gmsh knows the first.
    std::string extensions;
    std::string description;
    /// Whether cells are made of a geometry; a mesh has them.
    bool is_geometry;
    /// Whether the geometry is a surface of triangles.
    bool is_surface = false;
  };

  const std::vector<MeshFormatDescription> &
  mesh_formats();

  /**
   * The format of a file, by its content; a geometry of gmsh (.geo), which
   * begins with anything, by its name, and so a file that begins like no format
   * but has the name of one. Throws InputError blamed on the parameter @p entry
   * if it is none, and MachineError if the file cannot be read.
   */
  const MeshFormatDescription &
  mesh_format(const std::string &path, const std::string &entry);

  /**
   * Throws InputError if a file of a format that has a last word (Nastran,
   * UNV, Medit) does not end with it: the rest would be missing in silence. So
   * would what a file of Nastran includes, which is refused, too.
   */
  void
  check_end(const std::string &path, const MeshFormat format);
} // namespace corotet

#endif
