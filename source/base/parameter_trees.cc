// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_trees.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "parameter_places.h"

namespace corotet
{
  namespace
  {
    using Statements = std::vector<ParameterStatement>;

    // ParameterHandler's spelling of names in .xml files: all but letters and
    // digits as _ and two hexadecimal digits.
    std::string
    demangle(const std::string &name)
    {
      std::string result;
      for (std::size_t i = 0; i < name.size(); ++i)
        if (name[i] == '_' && i + 2 < name.size())
          {
            result += static_cast<char>(
              std::strtol(name.substr(i + 1, 2).c_str(), nullptr, 16));
            i += 2;
          }
        else
          result += name[i];
      return result;
    }

    // The position behind the first @p end from @p begin on, or the end of the
    // text if there is none.
    std::size_t
    behind(const std::string &text,
           const std::size_t  begin,
           const std::string &end)
    {
      const std::size_t found = text.find(end, begin);
      return found == std::string::npos ? text.size() : found + end.size();
    }

    // The end of a tag: a > outside of quotation marks.
    std::size_t
    end_of_tag(const std::string &text, std::size_t i)
    {
      for (char quote = '\0'; i < text.size(); ++i)
        if (quote != '\0')
          quote = text[i] == quote ? '\0' : quote;
        else if (text[i] == '>')
          return i;
        else if (text[i] == '"' || text[i] == '\'')
          quote = text[i];
      return i;
    }

    // The name of the tag whose name begins at @p start.
    std::string
    name_of_tag(const std::string &text, const std::size_t start)
    {
      return text.substr(start, text.find_first_of(" \t\r\n/>", start) - start);
    }

    // Checks the nesting of elements before Boost's reader, which is recursive,
    // has no limit, and does not compare the names of ends. Returns the places
    // of the elements, except for the outermost one.
    Places
    check_xml(const std::string &path, const std::string &text)
    {
      Places                   places{path, {}};
      std::vector<std::string> open;
      std::size_t              n_elements = 0, line = 1, counted = 0;
      for (std::size_t i = text.find('<'); i < text.size();
           i             = text.find('<', i))
        {
          line += std::count(text.begin() + counted, text.begin() + i, '\n');
          counted = i;
          if (text.compare(i, 4, "<!--") == 0)
            i = behind(text, i + 4, "-->");
          else if (text.compare(i, 9, "<![CDATA[") == 0)
            i = behind(text, i + 9, "]]>");
          else if (text.compare(i, 2, "<!") == 0)
            refuse_statement(
              path, "it has a document type or entities; allowed are neither");
          else if (text.compare(i, 2, "<?") == 0)
            i = behind(text, i + 2, "?>");
          else if (text.compare(i, 2, "</") == 0)
            {
              const std::string name = name_of_tag(text, i + 2);
              if (!open.empty() && name != open.back())
                refuse_statement(
                  fmt::format("{}:{}", path, line),
                  fmt::format("it is no valid XML: found '</{}>', the end of "
                                          "another element; allowed: '</{}>'",
                              shortened(name),
                              shortened(open.back())));
              if (!open.empty())
                open.pop_back();
              i = behind(text, i + 2, ">");
            }
          else
            {
              open.push_back(name_of_tag(text, i + 1));
              std::vector<std::string> names;
              std::transform(open.begin() + 1,
                             open.end(),
                             std::back_inserter(names),
                             demangle);
              places.add(names, line);
              i = end_of_tag(text, i + 1);
              if (text[i - 1] == '/')
                open.pop_back();
              if (open.size() > std::size_t(max_section_depth))
                refuse_as_too_deep(path);
              if (++n_elements > max_tree_entries)
                refuse_as_too_many(path);
            }
        }
      return places;
    }

    void
    collect(const boost::property_tree::ptree &tree,
            const std::string                 &path,
            const Places                      &places,
            Statements                        &statements)
    {
      std::set<std::string> names;
      for (const auto &[key, node] : tree)
        {
          if (key == "<xmlcomment>" || node.get_optional<std::string>("alias"))
            continue;
          const std::string name =
            path.empty() ? demangle(key) : path + "/" + demangle(key);
          const std::string place = places.of(name);
          if (!names.insert(name).second)
            refuse_second(place, name);
          const auto value = node.get_optional<std::string>("value");
          if (value || node.empty())
            {
              const std::string text =
                dealii::Utilities::trim(value ? *value : node.data());
              add_statement(statements,
                            {name, text, place, !value && text.empty()});
            }
          else
            {
              const std::string text = dealii::Utilities::trim(node.data());
              if (!text.empty())
                refuse_statement(place,
                                 fmt::format("found the text '{}' in \"{}\"; "
                                             "allowed there are elements",
                                             shortened(text),
                                             name));
              add_statement(statements, {name, std::nullopt, place});
              collect(node, name, places, statements);
            }
        }
    }

  } // namespace

  void
  refuse_statement(const std::string &place, const std::string &message)
  {
    throw InputError("", place + ": " + message);
  }

  void
  check_zero_bytes(const std::string &text, const std::string &place)
  {
    if (text.find('\0') != std::string::npos)
      refuse_statement(place, "it has a zero byte; a parameter file is text");
  }

  void
  refuse_second(const std::string &place,
                const std::string &name,
                const std::string &first)
  {
    refuse_statement(place,
                     fmt::format("\"{}\" is set twice{}; allowed is once in a "
                                 "file",
                                 shortened(name),
                                 first));
  }

  void
  add_statement(std::vector<ParameterStatement> &statements,
                const ParameterStatement        &statement)
  {
    if (statements.size() == max_statements)
      refuse_statement(statement.place,
                       fmt::format("there are more than {} statements",
                                   max_statements));
    if (statement.path.size() > max_path_length)
      refuse_statement(statement.place,
                       fmt::format("the name \"{}\", with the sections it is "
                                   "in, is too long; allowed are {} characters",
                                   shortened(statement.path),
                                   max_path_length));
    statements.push_back(statement);
  }

  void
  refuse_as_too_deep(const std::string &place)
  {
    refuse_statement(
      place,
      fmt::format("its elements are nested too deeply; allowed are {} "
                  "levels",
                  max_section_depth));
  }

  void
  refuse_as_too_many(const std::string &path)
  {
    refuse_statement(path,
                     fmt::format("it has more than {} elements; allowed are as "
                                 "many",
                                 max_tree_entries));
  }

  std::vector<ParameterStatement>
  read_xml_statements(const std::string &path, std::istream &file)
  {
    const std::string           text = read_to_end(file, path);
    boost::property_tree::ptree tree;
    const Places                places = check_xml(path, text);
    std::istringstream          stream(text);
    try
      {
        boost::property_tree::read_xml(
          stream, tree, boost::property_tree::xml_parser::no_comments);
      }
    catch (const boost::property_tree::xml_parser_error &error)
      {
        refuse_statement(fmt::format("{}:{}", path, error.line()),
                         "it is no valid XML: " + error.message());
      }
    const auto root = tree.get_child_optional("ParameterHandler");
    if (!root || tree.size() != 1)
      refuse_statement(
        path, "it must have one outermost element, called ParameterHandler");
    Statements statements;
    collect(*root, "", places, statements);
    return statements;
  }
} // namespace corotet
