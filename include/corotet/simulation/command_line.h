// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_command_line_h
#define corotet_simulation_command_line_h

#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * What "corotet mesh FILE" asks for: to read, check and describe a mesh.
   */
  struct MeshCommand
  {
    std::string  file;
    double       element_size    = 0;
    double       feature_angle   = 40;
    unsigned int geometry_degree = 1;
    /// The .msh or .h5 file to write; empty if none is to be written.
    std::string out;
  };

  /**
   * What the command line asks for.
   */
  struct CommandLine
  {
    /// The file's name as given. Empty only if there is a message, or if
    /// something is to be listed without reading a file.
    std::string parameter_file;
    /// Each "Section/Subsection/Entry = value", in the given order, not yet
    /// checked.
    std::vector<std::string> overrides;
    /// Replaces the output directory of the parameter file.
    std::optional<std::string> output_directory;
    /// Whether to read and check everything, and run nothing.
    bool validate = false;
    /// Whether to go on with what is in the output directory.
    bool restart = false;
    /// Whether to write the report page of the run, too.
    bool report = false;
    /// Whether to write nothing on the terminal but errors.
    bool quiet = false;
    /// The style in which to list all parameters, and do nothing else: "prm",
    /// "json", "markdown" or "schema".
    std::optional<std::string> print_parameters;
    /// Whether to list what there is to choose from, and do nothing else.
    bool list = false;
    /// The mesh to describe, doing nothing else.
    std::optional<MeshCommand> mesh;
    /// The answer to --help or --version, to be printed, doing nothing else.
    std::optional<std::string> message;
  };

  /**
   * Throws InputError if the command line is wrong.
   */
  CommandLine
  parse_command_line(const int argc, const char *const *argv);
} // namespace corotet

#endif
