// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_trees.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace corotet
{
  namespace
  {
    using Statements = std::vector<ParameterStatement>;

    [[noreturn]] void
    refuse_as_too_many(const std::string &path)
    {
      refuse_statement(path,
                       fmt::format("it has more than {} elements; allowed are "
                                   "as many",
                                   max_tree_entries));
    }

    // Where what begins at @p begin ends by @p end: behind that, or at the end
    // of the text.
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

    // Of the tag whose name begins at @p start.
    std::string
    name_of_tag(const std::string &text, const std::size_t start)
    {
      return text.substr(start, text.find_first_of(" \t\r\n/>", start) - start);
    }

    // Before the reader proper sees it, which takes from its stack for each
    // level, has no limit, and does not look at the names of ends.
    void
    check_xml(const std::string &path, const std::string &text)
    {
      std::vector<std::string> open;
      std::size_t              n_elements = 0;
      for (std::size_t i = text.find('<'); i < text.size();
           i             = text.find('<', i))
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
                fmt::format("{}:{}",
                            path,
                            1 +
                              std::count(text.begin(), text.begin() + i, '\n')),
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
            const std::string name = name_of_tag(text, i + 1);
            i                      = end_of_tag(text, i + 1);
            if (text[i - 1] != '/')
              open.push_back(name);
            if (open.size() > std::size_t(max_section_depth))
              refuse_as_too_deep(path);
            if (++n_elements > max_tree_entries)
              refuse_as_too_many(path);
          }
    }

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

    void
    collect(const boost::property_tree::ptree &tree,
            const std::string                 &path,
            const std::string                 &file,
            Statements                        &statements)
    {
      std::set<std::string> names;
      for (const auto &[key, node] : tree)
        {
          if (key == "<xmlcomment>" || node.get_optional<std::string>("alias"))
            continue;
          const std::string name =
            path.empty() ? demangle(key) : path + "/" + demangle(key);
          if (!names.insert(name).second)
            refuse_second(file, name);
          const auto value = node.get_optional<std::string>("value");
          if (value || node.empty())
            {
              const std::string text =
                dealii::Utilities::trim(value ? *value : node.data());
              add_statement(statements,
                            {name, text, file, !value && text.empty()});
            }
          else
            {
              const std::string text = dealii::Utilities::trim(node.data());
              if (!text.empty())
                refuse_statement(file,
                                 fmt::format("found the text '{}' in \"{}\"; "
                                             "allowed there are elements",
                                             shortened(text),
                                             name));
              add_statement(statements, {name, std::nullopt, file});
              collect(node, name, file, statements);
            }
        }
    }

    void
    collect(const nlohmann::ordered_json &tree,
            const std::string            &path,
            const std::string            &file,
            Statements                   &statements)
    {
      for (const auto &[key, node] : tree.items())
        {
          const std::string name  = path.empty() ? key : path + "/" + key;
          const bool        whole = node.is_object() && node.contains("value");
          const auto       &value = whole ? node.at("value") : node;
          if (value.is_object())
            {
              if (value.contains("alias"))
                continue;
              add_statement(statements, {name, std::nullopt, file});
              collect(value, name, file, statements);
            }
          else if (value.is_string())
            {
              const std::string text =
                dealii::Utilities::trim(value.get<std::string>());
              add_statement(statements,
                            {name, text, file, !whole && text.empty()});
            }
          else if (value.is_number() || value.is_boolean())
            add_statement(statements, {name, value.dump(), file});
          else
            refuse_statement(
              file,
              fmt::format("\"{}\" is {}; allowed are a text, a number, true "
                          "and false",
                          shortened(name),
                          value.is_null() ? "null" : "a list"));
        }
    }
  } // namespace

  void
  refuse_statement(const std::string &place, const std::string &message)
  {
    throw InputError("", place + ": " + message);
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

  std::vector<ParameterStatement>
  read_xml_statements(const std::string &path, std::istream &file)
  {
    const std::string           text{std::istreambuf_iterator<char>(file), {}};
    boost::property_tree::ptree tree;
    check_xml(path, text);
    std::istringstream stream(text);
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
    collect(*root, "", path, statements);
    return statements;
  }

  std::vector<ParameterStatement>
  read_json_statements(const std::string &path, std::istream &file)
  {
    nlohmann::ordered_json tree;
    // The parser keeps the last of several members with one name. Those of the
    // objects that are open:
    std::vector<std::set<std::string>> names;
    std::size_t                        n_entries = 0;
    try
      {
        using Event = nlohmann::ordered_json::parse_event_t;
        tree        = nlohmann::ordered_json::parse(
          file, [&](const int depth, const Event event, const auto &value) {
            if (depth > max_section_depth)
              refuse_as_too_deep(path);
            // Names, values, and both ends of objects and lists.
            if (++n_entries > 2 * max_tree_entries)
              refuse_as_too_many(path);
            if (event == Event::object_start)
              names.emplace_back();
            else if (event == Event::object_end)
              names.pop_back();
            else if (event == Event::key &&
                     !names.back()
                        .insert(value.template get<std::string>())
                        .second)
              refuse_second(path, value.template get<std::string>());
            return true;
          });
      }
    catch (const nlohmann::json::exception &error)
      {
        // "[...] parse error at line 3, column 5: reason"
        const std::string text  = error.what();
        const std::string start = "at line ";
        const std::size_t line  = text.find(start);
        const std::size_t comma = text.find(", column ", line);
        const std::size_t colon = text.find(": ", comma);
        const bool        found = line != std::string::npos &&
                           comma != std::string::npos &&
                           colon != std::string::npos;
        const std::size_t number = line + start.size();
        refuse_statement(
          found ? path + ":" + text.substr(number, comma - number) : path,
          "it is no valid JSON: " +
            shortened(found ? text.substr(colon + 2) : text, 200));
      }
    if (!tree.is_object())
      refuse_statement(path, "it must be one JSON object, {...}");
    // Names the file's schema, for editors.
    if (const auto schema = tree.find("$schema");
        schema != tree.end() && schema->is_string())
      tree.erase(schema);
    Statements statements;
    collect(tree, "", path, statements);
    return statements;
  }
} // namespace corotet
