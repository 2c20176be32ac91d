// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/parameter_trees.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "parameter_places.h"

namespace corotet
{
  namespace
  {
    void
    collect_json(const nlohmann::ordered_json    &tree,
                 const std::string               &path,
                 const Places                    &places,
                 std::vector<ParameterStatement> &statements)
    {
      for (const auto &[key, node] : tree.items())
        {
          const std::string name  = path.empty() ? key : path + "/" + key;
          const bool        whole = node.is_object() && node.contains("value");
          const auto       &value = whole ? node.at("value") : node;
          const std::string place = places.of(whole ? name + "/value" : name);
          check_zero_bytes(key, place);
          if (value.is_object())
            {
              if (value.contains("alias"))
                continue;
              add_statement(statements, {name, std::nullopt, place});
              collect_json(value, name, places, statements);
            }
          else if (value.is_string())
            {
              const std::string text =
                dealii::Utilities::trim(value.get<std::string>());
              check_zero_bytes(text, place);
              add_statement(statements,
                            {name, text, place, !whole && text.empty()});
            }
          else if (value.is_number() || value.is_boolean())
            add_statement(statements, {name, value.dump(), place});
          else
            refuse_statement(
              place,
              fmt::format("\"{}\" is {}; allowed are a text, a number, true "
                          "and false",
                          shortened(name),
                          value.is_null() ? "null" : "a list"));
        }
    }

    // Iterates over the characters of a text and counts its lines.
    struct CountingIterator
    {
      using iterator_category = std::input_iterator_tag;
      using value_type        = char;
      using difference_type   = std::ptrdiff_t;
      using pointer           = const char *;
      using reference         = const char &;

      reference
      operator*() const
      {
        return *place;
      }

      CountingIterator &
      operator++()
      {
        *line += *place++ == '\n' ? 1 : 0;
        return *this;
      }

      bool
      operator==(const CountingIterator &other) const
      {
        return place == other.place;
      }

      const char  *place;
      std::size_t *line;
    };

    // Parses @p text and puts the places of its members into @p places.
    nlohmann::ordered_json
    parse_json(const std::string &path, const std::string &text, Places &places)
    {
      // The parser keeps only the last of several members with the same name,
      // so they are checked here: the names of members in each open object, and
      // their lines.
      std::vector<std::map<std::string, std::size_t>> names;
      // The current member of each open object.
      std::vector<std::string> members;
      std::size_t              n_entries = 0, line = 1;
      using Event = nlohmann::ordered_json::parse_event_t;
      return nlohmann::ordered_json::parse(
        CountingIterator{text.data(), &line},
        CountingIterator{text.data() + text.size(), &line},
        [&](const int depth, const Event event, const auto &value) {
          if (depth > max_section_depth)
            refuse_as_too_deep(path);
          // Events are names, values, and both ends of objects and lists.
          if (++n_entries > 2 * max_tree_entries)
            refuse_as_too_many(path);
          if (event == Event::object_start)
            {
              names.emplace_back();
              members.emplace_back();
            }
          else if (event == Event::object_end)
            {
              names.pop_back();
              members.pop_back();
            }
          else if (event == Event::key)
            {
              members.back() = value.template get<std::string>();
              const auto [first, is_new] =
                names.back().emplace(members.back(), line);
              if (!is_new)
                refuse_second(fmt::format("{}:{}", path, line),
                              members.back(),
                              fmt::format(", first in line {}", first->second));
              places.add(members, line);
            }
          return true;
        });
    }
  } // namespace

  std::vector<ParameterStatement>
  read_json_statements(const std::string &path, std::istream &file)
  {
    const std::string      text = read_to_end(file, path);
    Places                 places{path, {}};
    nlohmann::ordered_json tree;
    try
      {
        tree = parse_json(path, text, places);
      }
    catch (const nlohmann::json::exception &error)
      {
        // "[...] parse error at line 3, column 5: reason"
        const std::string what  = error.what();
        const std::string start = "at line ";
        const std::size_t line  = what.find(start);
        const std::size_t comma = what.find(", column ", line);
        const std::size_t colon = what.find(": ", comma);
        const bool        found = line != std::string::npos &&
                           comma != std::string::npos &&
                           colon != std::string::npos;
        const std::size_t number = line + start.size();
        refuse_statement(
          found ? path + ":" + what.substr(number, comma - number) : path,
          "it is no valid JSON: " +
            shortened(found ? what.substr(colon + 2) : what, 200));
      }
    if (!tree.is_object())
      refuse_statement(path, "it must be one JSON object, {...}");
    // The member "$schema" names the file's schema, for editors.
    if (const auto schema = tree.find("$schema");
        schema != tree.end() && schema->is_string())
      tree.erase(schema);
    std::vector<ParameterStatement> statements;
    collect_json(tree, "", places, statements);
    return statements;
  }
} // namespace corotet
