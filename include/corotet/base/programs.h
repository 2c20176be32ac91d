// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_programs_h
#define corotet_base_programs_h

#include <string>
#include <vector>

namespace corotet
{
  /**
   * The path of a file that is installed with the library; @p name is relative
   * to the installation ("share/corotet/scripts/draw_study"). It is looked for
   * in the nearest folder above the running program that has it, above the file
   * with this code (the shared library), or above the `corotet` that a shell
   * would start. So it is found wherever the installation, or the folder of the
   * build, was moved to. Empty if there is none.
   */
  std::string
  find_installed(const std::string &name);

  /// The end of a program.
  struct ProgramEnd
  {
    /// The standard output of the program.
    std::string output;
    /// Exit status; 0 if a signal ended it.
    int status = 0;
    /// The signal that ended it; 0 if none did.
    int  signal       = 0;
    bool has_exceeded = false;
  };

  /**
   * Runs the program at @p path with @p arguments, without a shell, waits for
   * its end and takes its standard output. It reads nothing from its standard
   * input, its messages are thrown away, and it does not know that this program
   * is a rank of several. After @p time_limit seconds it is ended by SIGKILL
   * (ProgramEnd::has_exceeded). Throws MachineError if it cannot be started.
   */
  ProgramEnd
  run_for_output(const std::string              &path,
                 const std::vector<std::string> &arguments,
                 const double                    time_limit);

  /// Runs a script that is installed with the library ("report") for a folder.
  /// Whether it was found, and has ended with status 0 within an hour.
  bool
  run_installed_script(const std::string &name, const std::string &folder);

  /// A path that no program takes for an option: "./-x" for "-x".
  std::string
  as_argument(const std::string &path);
} // namespace corotet

#endif
