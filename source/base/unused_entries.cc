// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_listing.h>
#include <corotet/base/text.h>
#include <corotet/base/unused_entries.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>

namespace corotet
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    std::string
    below(const std::string &path, const std::string &name)
    {
      return path.empty() ? name : path + "/" + name;
    }

    // Paths of the entries in @p section, which is at @p path, and below it,
    // that were set to another value than their default.
    void
    find_changed_entries(const ParameterFile      &file,
                         const Json               &section,
                         const std::string        &path,
                         std::vector<std::string> &changed)
    {
      for (const auto &[name, node] : section.items())
        if (is_entry(node))
          {
            const std::string entry = below(path, name);
            if (file.is_set(entry) &&
                node.at("value") != node.at("default_value"))
              changed.push_back(entry);
          }
        else if (node.is_object() && is_section(node))
          find_changed_entries(file, node, below(path, name), changed);
    }

    class Finder
    {
    public:
      Finder(const ParameterFile &file, const std::vector<std::string> &used)
        : file(file)
        , used(used)
      {}

      void
      find(const Json &section, const std::string &path)
      {
        if (section.contains("Type") && is_entry(section.at("Type")))
          for (const std::string &candidate : selection_names(
                 section.at("Type").value("pattern_description", "")))
            check_candidate(section, path, candidate);
        for (const auto &[name, node] : section.items())
          if (node.is_object() && is_section(node))
            find(node, below(path, name));
      }

      std::vector<std::string> lines;

    private:
      void
      check_candidate(const Json        &section,
                      const std::string &path,
                      const std::string &candidate)
      {
        const std::string selected = section.at("Type").at("value");
        // Sections of a whole file begin with a capital letter.
        std::string name = candidate;
        if (path.empty())
          name[0] = std::toupper(static_cast<unsigned char>(name[0]));
        const std::string place = below(path, name);
        if (candidate == selected || !section.contains(name) ||
            std::find(used.begin(), used.end(), place) != used.end())
          return;
        std::vector<std::string> changed;
        find_changed_entries(file, section.at(name), place, changed);
        if (changed.empty())
          return;
        const std::string choice = below(path, "Type");
        if (!file.is_set(choice))
          throw InputError(changed.front(),
                           fmt::format("it would have no effect: \"{}\" is not "
                                       "set, and its default is '{}'; allowed "
                                       "with \"{} = {}\"",
                                       choice,
                                       selected,
                                       choice,
                                       candidate));
        lines.push_back(fmt::format("{}: no effect, as \"{}\" is '{}': {}",
                                    file.location(changed.front()),
                                    choice,
                                    selected,
                                    join(changed)));
      }

      const ParameterFile            &file;
      const std::vector<std::string> &used;
    };
  } // namespace

  std::vector<std::string>
  find_unused_entries(const ParameterFile            &file,
                      const std::vector<std::string> &used)
  {
    Finder finder(file, used);
    finder.find(file.tree(), "");
    return finder.lines;
  }
} // namespace corotet
