// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/programs.h>
#include <corotet/base/text.h>
#include <corotet/mesh/vtk_file.h>

#include <deal.II/base/utilities.h>

#include <filesystem>

#include "program_failure.h"

namespace corotet
{
  std::string
  write_msh_of_vtk_file(const std::string &path,
                        const std::string &target,
                        const double       time_limit,
                        const std::string &time_limit_entry)
  {
    const std::string name   = "share/corotet/scripts/read_vtk";
    const std::string script = find_installed(name);
    if (script.empty())
      throw MachineError(name + ", which reads files of VTK, is missing: it is "
                                "sought above the running program, above the "
                                "library, and above the first corotet in PATH");
    const ProgramEnd  end = run_for_output(script, {path, target}, time_limit);
    const std::string message =
      shortened(dealii::Utilities::trim(end.output), 300);
    if (!end.has_exceeded && end.signal == 0 && end.status == 0 &&
        std::filesystem::exists(target))
      return message;
    // A shell, or env, ends with these if there is no Python.
    if (end.status == 126 || end.status == 127)
      throw MachineError(path + ": Python, which reads files of VTK, is "
                                "missing (Debian's packages: python3, "
                                "python3-vtk9)");
    if (end.status == 3)
      throw MachineError(path + ": " + message);
    if (end.status == 1 && !message.empty())
      throw InputError("", path + ": " + message);
    refuse_end(end, "VTK", path, time_limit, time_limit_entry);
  }
} // namespace corotet
