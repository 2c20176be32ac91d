// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_check_gmsh_file_h
#define corotet_mesh_check_gmsh_file_h

#include <string>

namespace corotet
{
  /**
   * Refuses an incomplete .msh file before it is read: it must start with
   * '$MeshFormat', or comments before it, and have complete sections '$Nodes'
   * (or '$ParametricNodes') and '$Elements'. Returns the version of its format.
   * Throws InputError, and MachineError if the file cannot be read.
   */
  double
  check_msh(const std::string &path);

  /**
   * Refuses a .geo file, which is a program, that contains instructions which
   * would run commands, write files, read files outside of its folder or end
   * gmsh; included files are checked, too. Names that are composed at run time
   * cannot be checked here: the process in which gmsh runs cannot open such
   * files. Throws InputError with file and line, and MachineError if a file
   * cannot be read.
   */
  void
  check_geo(const std::string &path);
} // namespace corotet

#endif
