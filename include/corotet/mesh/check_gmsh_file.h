// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_gmsh_file_h
#define corotet_mesh_check_gmsh_file_h

#include <string>

namespace corotet
{
  /**
   * Refuses a .msh that is not a whole one, before it is read: it must start
   * with '$MeshFormat', or comments before it, and have all of '$Nodes', or
   * '$ParametricNodes', and '$Elements'. Returns its version. Throws
   * InputError, and MachineError if it cannot be read.
   */
  double
  check_msh(const std::string &path);

  /**
   * Refuses a .geo, which is a program, that contains what would run commands,
   * write files, read files outside of its folder or end gmsh; files that it
   * includes are read, too. Names that are composed at run time are not seen
   * here: the process in which gmsh runs cannot open them. Throws InputError
   * with file and line, and MachineError if a file cannot be read.
   */
  void
  check_geo(const std::string &path);
} // namespace corotet

#endif
