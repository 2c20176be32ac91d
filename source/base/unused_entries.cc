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

    // Finds the paths of the entries at @p path, where @p node is an entry or a
    // section, whose values are not their defaults.
    void
    find_changed_entries(const ParameterFile      &file,
                         const Json               &node,
                         const std::string        &path,
                         std::vector<std::string> &changed)
    {
      if (is_entry(node))
        {
          if (file.is_set(path) && node.at("value") != node.at("default_value"))
            changed.push_back(path);
        }
      else if (node.is_object() && is_section(node))
        for (const auto &[name, inner] : node.items())
          find_changed_entries(file, inner, below(path, name), changed);
    }

    const Json &
    at(const Json &tree, const std::string &path)
    {
      const Json *node = &tree;
      for (std::size_t begin = 0; begin <= path.size();)
        {
          const std::size_t end = std::min(path.find('/', begin), path.size());
          node                  = &node->at(path.substr(begin, end - begin));
          begin                 = end + 1;
        }
      return *node;
    }

    std::string
    unused_line(const ParameterFile            &file,
                const std::vector<std::string> &entries,
                const std::string              &choice,
                const std::string              &selected)
    {
      return fmt::format("{}: no effect, as \"{}\" is '{}': {}",
                         file.location(entries.front()),
                         choice,
                         selected,
                         join(entries));
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
        // Sections at the top level begin with a capital letter.
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
        lines.push_back(unused_line(file, changed, choice, selected));
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

  std::string
  unused_entry(const ParameterFile &file,
               const std::string   &place,
               const std::string   &choice)
  {
    const Json               tree = file.tree();
    std::vector<std::string> changed;
    find_changed_entries(file, at(tree, place), place, changed);
    return changed.empty() ?
             "" :
             unused_line(file, changed, choice, at(tree, choice).at("value"));
  }
} // namespace corotet
