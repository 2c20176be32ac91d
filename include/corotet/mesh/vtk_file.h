// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_vtk_file_h
#define corotet_mesh_vtk_file_h

#include <string>

namespace corotet
{
  /**
   * Makes VTK read the file @p path, in a process of its own (scripts/read_vtk,
   * which tells what is read), and write its mesh to the file @p target for
   * read_msh_2() with zero_is_group. Returns a remark for the log, in one line.
   * Throws InputError if the process fails, is ended by a signal, or takes
   * longer than @p time_limit [s], which the parameter @p time_limit_entry
   * sets, and MachineError if Python or VTK is missing.
   */
  std::string
  write_msh_of_vtk_file(const std::string &path,
                        const std::string &target,
                        const double       time_limit,
                        const std::string &time_limit_entry);
} // namespace corotet

#endif
