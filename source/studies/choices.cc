// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/programs.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/forces/force_kind.h>
#include <corotet/laws/law_kind.h>
#include <corotet/mesh/mesh_format.h>
#include <corotet/mesh/mesh_sources.h>
#include <corotet/solvers/preconditioners.h>
#include <corotet/studies/choices.h>
#include <corotet/time_integration/time_integrators.h>

#include <fmt/format.h>

#include <filesystem>
#include <map>

namespace corotet
{
  namespace
  {
    // The length of a line of text on a terminal.
    constexpr std::size_t most_letters = 96;



    std::string
    ready_cases()
    {
      namespace fs             = std::filesystem;
      const std::string folder = find_installed("share/corotet/parameters");
      std::map<std::string, std::string> cases;
      std::error_code                    error;
      for (const fs::directory_entry &entry :
           fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".prm")
          {
            cases[entry.path().stem().string()] =
              first_sentence(read_whole_file(entry.path().string()));
          }
      if (cases.empty())
        return "Ready cases: none is installed\n";
      std::string result =
        "Ready cases, in " + fs::weakly_canonical(folder).string() + ":\n";
      for (const auto &[name, about] : cases)
        result += fmt::format("  {:<22}{}\n", name, about);
      return result;
    }



    template <typename Base>
    std::string
    line(const std::string &title, const std::vector<Candidate<Base>> &all)
    {
      std::vector<std::string> names;
      for (const Candidate<Base> &candidate : all)
        names.push_back(candidate.name);
      return fmt::format("{}: {}\n", title, join(names));
    }



    std::string
    formats()
    {
      std::string result = "Files of meshes and geometries (Mesh/Type = "
                           "file):\n";
      for (const MeshFormatDescription &format : mesh_formats())
        result +=
          fmt::format("  {:<22}{}\n", format.extensions, format.description);
      return result;
    }
  } // namespace



  std::string
  first_sentence(const std::string &parameter_file)
  {
    std::istringstream lines(parameter_file);
    std::string        text;
    for (std::string line; std::getline(lines, line) && line[0] == '#';)
      {
        const std::size_t begin = line.find_first_not_of("# \t\r");
        if (begin == std::string::npos)
          break;
        text += (text.empty() ? "" : " ") + line.substr(begin);
      }
    // A full stop within a number or an abbreviation has no blank behind it,
    // and an ellipsis has several full stops.
    std::size_t end = text.find(". ");
    while (end != std::string::npos && text[end - 1] == '.')
      end = text.find(". ", end + 1);
    text = text.substr(0, end);
    while (!text.empty() && text.back() == '.')
      text.pop_back();
    if (text.size() <= most_letters)
      return text;
    return text.substr(0, text.rfind(' ', most_letters - 4)) + " ...";
  }



  std::string
  list_choices()
  {
    return ready_cases() + line("Laws (Material/Type)", law_kinds()) +
           line("Forces", force_kinds()) +
           line("Integrators (Time integration/Type)", time_integrators()) +
           line("Preconditioners (Linear solver/Type)", preconditioners()) +
           line("Meshes (Mesh/Type)", mesh_sources()) + formats();
  }
} // namespace corotet
