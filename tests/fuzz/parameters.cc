// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Parameter files in all formats, read as the program reads them: what is
// accepted can be written and read again with the same values.

#include <corotet/base/parameter_file.h>
#include <corotet/studies/run_parameters.h>

#include <nlohmann/json.hpp>

#include "targets.h"

namespace fuzz
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    // The extension of a file's format, which its first character tells.
    std::string
    ending_of(const std::string &input)
    {
      const std::size_t first = input.find_first_not_of(" \t\r\n");
      const char        c     = first == std::string::npos ? ' ' : input[first];
      if (c == '{' || c == '[')
        return ".json";
      return c == '<' ? ".xml" : ".prm";
    }

    // Uses all entries that need no mesh.
    void
    use(const corotet::RunParameters &parameters, const std::string &path)
    {
      is_accepted([&] { parameters.output.probe_points(); });
      is_accepted([&] { parameters.output.stress_probe_points(); });
      is_accepted([&] { parameters.study.cases(); });
      is_accepted([&] { parameters.study.quantity_list(); });
      parameters.output.directory_of_run(path);
    }

    // All values but names of files, which become relative to another folder
    // and so are written differently.
    Json
    values_but_files(const corotet::ParameterFile &file)
    {
      Json values = file.values();
      values["Mesh"]["gmsh"].erase("File");
      values.erase("Tables");
      return values;
    }
  } // namespace

  void
  read_parameters(const std::string &input)
  {
    static const std::string part = write("part.prm", "set Type = modes\n");
    const std::string        path = write("case" + ending_of(input), input);
    // Only well formed files are read into declared entries, which takes
    // longer.
    if (!is_accepted([&] { corotet::read_parameter_statements(path); }))
      return;
    corotet::RunParameters parameters;
    corotet::ParameterFile file;
    parameters.declare_parameters(file.handler());
    if (!is_accepted([&] { file.read(path, {}); }))
      return;
    use(parameters, path);

    const std::string written = scratch() / "written.prm";
    // Some names of files could not be read again, so they are refused here.
    if (!is_accepted([&] { file.write_effective(written); }))
      return;
    corotet::RunParameters parameters_again;
    corotet::ParameterFile again;
    parameters_again.declare_parameters(again.handler());
    try
      {
        again.read(written, {});
      }
    catch (const corotet::Error &error)
      {
        require(false, std::string("what is written is read: ") + error.what());
      }
    require(values_but_files(file) == values_but_files(again),
            "what is written has the values that were read");
  }
} // namespace fuzz
