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
    /// The name of the format in lower case: "step".
    std::string name;
    /// The usual endings of file names: ".step, .stp". gmsh knows the first.
    std::string extensions;
    std::string description;
    /// Whether the file has a geometry, for which cells are made; otherwise it
    /// has a mesh.
    bool is_geometry;
    /// Whether the geometry is a surface of triangles.
    bool is_surface = false;
  };

  const std::vector<MeshFormatDescription> &
  mesh_formats();

  /**
   * The format of a file, recognized by its content. A geometry of gmsh (.geo),
   * which may begin with anything, is recognized by its name, and so is a file
   * that begins like no known format. Throws InputError blamed on the parameter
   * @p entry if the format is unknown, and MachineError if the file cannot be
   * read.
   */
  const MeshFormatDescription &
  mesh_format(const std::string &path, const std::string &entry);

  /**
   * Throws InputError if a file of a format that has a last word (Nastran, UNV,
   * Medit) does not end with it: a part would be missing without notice. For
   * the same reason Nastran files that include other files are refused.
   */
  void
  check_end(const std::string &path, const MeshFormat format);
} // namespace corotet

#endif
