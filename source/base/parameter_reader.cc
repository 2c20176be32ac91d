// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_reader.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;

    using Statements = std::vector<ParameterStatement>;

    // A file that includes itself would otherwise never end.
    constexpr unsigned int max_include_depth = 10;

    [[noreturn]] void
    fail(const std::string &place, const std::string &message)
    {
      throw InputError("", place + ": " + message);
    }

    std::ifstream
    open(const std::string &path)
    {
      if (!fs::exists(path))
        fail(path, "there is no such file");
      std::ifstream file(path);
      if (fs::is_directory(path) || !file)
        fail(path, "it cannot be read as a file");
      return file;
    }

    // The rest of @p line behind @p keyword, or nothing if it does not start
    // with this word. deal.II knows keywords in lower and in upper case.
    std::optional<std::string>
    behind_keyword(const std::string &line, std::string keyword)
    {
      const auto matches = [&]() {
        return line.starts_with(keyword) &&
               (line.size() == keyword.size() || line[keyword.size()] == ' ');
      };
      bool found = matches();
      if (!found)
        {
          for (char &c : keyword)
            c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
          found = matches();
        }
      if (!found)
        return std::nullopt;
      return dealii::Utilities::trim(line.substr(keyword.size()));
    }

    // Reads .prm files: one object per run, over all included files.
    class PrmReader
    {
    public:
      void
      read(const std::string &path, const unsigned int depth = 0)
      {
        std::ifstream     file        = open(path);
        const std::size_t outer_depth = sections.size();
        std::string       line;
        std::string       concatenated;
        unsigned int      number       = 0;
        unsigned int      first_number = 1;
        while (std::getline(file, line))
          {
            ++number;
            line = dealii::Utilities::trim(line);
            if (concatenated.empty())
              first_number = number;
            const bool continued = !line.empty() && line.back() == '\\';
            if (continued)
              line.pop_back();
            concatenated += line;
            if (continued)
              continue;
            statement(concatenated, path, first_number, outer_depth, depth);
            concatenated.clear();
          }
        statement(concatenated, path, first_number, outer_depth, depth);
        if (sections.size() > outer_depth)
          fail(sections.back().second,
               fmt::format("subsection \"{}\" is opened here and never left; "
                           "an \"end\" is missing",
                           sections.back().first));
      }

      Statements statements;

    private:
      void
      statement(std::string        line,
                const std::string &file,
                const unsigned int number,
                const std::size_t  outer_depth,
                const unsigned int include_depth)
      {
        const std::string place = fmt::format("{}:{}", file, number);
        line                    = line.substr(0, line.find('#'));
        std::replace(line.begin(), line.end(), '\t', ' ');
        line = dealii::Utilities::trim(line);
        if (line.empty())
          return;

        if (const auto name = behind_keyword(line, "subsection"))
          {
            if (name->empty())
              fail(place, "\"subsection\" without a name");
            sections.emplace_back(*name, place);
            statements.push_back({path_of(""), std::nullopt, place});
          }
        else if (const auto rest = behind_keyword(line, "end"))
          {
            if (!rest->empty())
              fail(place,
                   fmt::format("\"{}\" behind \"end\"; nothing may follow",
                               *rest));
            if (sections.size() == outer_depth)
              fail(place, "\"end\", but there is no subsection to leave here");
            sections.pop_back();
          }
        else if (const auto assignment = behind_keyword(line, "set"))
          {
            const std::size_t equals = assignment->find('=');
            const std::string name =
              dealii::Utilities::trim(assignment->substr(0, equals));
            if (equals == std::string::npos || name.empty())
              fail(place,
                   fmt::format("\"{}\" is not of the form \"set Entry = "
                               "value\"",
                               line));
            statements.push_back(
              {path_of(name),
               dealii::Utilities::trim(assignment->substr(equals + 1)),
               place});
          }
        else if (const auto included = behind_keyword(line, "include"))
          {
            if (include_depth == max_include_depth)
              fail(place,
                   fmt::format("files include each other more than {} deep",
                               max_include_depth));
            const fs::path path = fs::path(file).parent_path() / *included;
            if (included->empty() || !fs::is_regular_file(path))
              fail(place,
                   fmt::format("the file to include, \"{}\", does not exist",
                               path.string()));
            read(path.string(), include_depth + 1);
          }
        else
          fail(place,
               fmt::format("\"{}\" is no statement; allowed are \"set Entry = "
                           "value\", \"subsection Name\", \"end\" and "
                           "\"include FILE\"",
                           line));
      }

      std::string
      path_of(const std::string &entry) const
      {
        std::vector<std::string> names;
        for (const auto &[name, place] : sections)
          names.push_back(name);
        if (!entry.empty())
          names.push_back(entry);
        return join(names, "/");
      }

      // Names of the subsections that are open, and where they were opened.
      std::vector<std::pair<std::string, std::string>> sections;
    };

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
      for (const auto &[key, node] : tree)
        {
          if (key == "<xmlcomment>" || node.get_optional<std::string>("alias"))
            continue;
          const std::string name =
            path.empty() ? demangle(key) : path + "/" + demangle(key);
          const auto value = node.get_optional<std::string>("value");
          if (value || node.empty())
            {
              const std::string text =
                dealii::Utilities::trim(value ? *value : node.data());
              statements.push_back({name, text, file, !value && text.empty()});
            }
          else
            {
              statements.push_back({name, std::nullopt, file});
              collect(node, name, file, statements);
            }
        }
    }

    Statements
    read_xml(const std::string &path)
    {
      std::ifstream               file = open(path);
      boost::property_tree::ptree tree;
      try
        {
          boost::property_tree::read_xml(
            file, tree, boost::property_tree::xml_parser::no_comments);
        }
      catch (const boost::property_tree::xml_parser_error &error)
        {
          fail(fmt::format("{}:{}", path, error.line()),
               "it is no valid XML: " + error.message());
        }
      const auto root = tree.get_child_optional("ParameterHandler");
      if (!root || tree.size() != 1)
        fail(path,
             "it must have one outermost element, called ParameterHandler");
      Statements statements;
      collect(*root, "", path, statements);
      return statements;
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
              statements.push_back({name, std::nullopt, file});
              collect(value, name, file, statements);
            }
          else if (value.is_string())
            {
              const std::string text =
                dealii::Utilities::trim(value.get<std::string>());
              statements.push_back({name, text, file, !whole && text.empty()});
            }
          else if (value.is_number() || value.is_boolean())
            statements.push_back({name, value.dump(), file});
          else
            fail(file,
                 fmt::format("\"{}\" is {}; allowed are a text, a number, true "
                             "and false",
                             name,
                             value.is_null() ? "null" : "a list"));
        }
    }

    Statements
    read_json(const std::string &path)
    {
      std::ifstream          file = open(path);
      nlohmann::ordered_json tree;
      try
        {
          tree = nlohmann::ordered_json::parse(file);
        }
      catch (const nlohmann::json::exception &error)
        {
          // "[...] parse error at line 3, column 5: reason"
          const std::string text = error.what();
          std::smatch       match;
          const bool        found = std::regex_search(
            text, match, std::regex("at line ([0-9]+), column [0-9]+: (.*)"));
          fail(found ? path + ":" + match[1].str() : path,
               "it is no valid JSON: " + (found ? match[2].str() : text));
        }
      if (!tree.is_object())
        fail(path, "it must be one JSON object, {...}");
      Statements statements;
      collect(tree, "", path, statements);
      return statements;
    }
  } // namespace

  std::vector<ParameterStatement>
  read_parameter_statements(const std::string &path)
  {
    const std::string ending = fs::path(path).extension().string();
    if (ending == ".json")
      return read_json(path);
    if (ending == ".xml")
      return read_xml(path);
    if (ending != ".prm")
      fail(path,
           fmt::format("a parameter file cannot end in \"{}\"; allowed are "
                       ".prm, .json and .xml",
                       ending));
    PrmReader reader;
    reader.read(path);
    return reader.statements;
  }

  ParameterStatement
  parse_override(const std::string &text)
  {
    const std::size_t        equals = text.find('=');
    std::vector<std::string> names;
    for (const std::string &name :
         dealii::Utilities::split_string_list(text.substr(0, equals), '/'))
      if (!name.empty())
        names.push_back(name);
    if (equals == std::string::npos || names.empty())
      fail("--set",
           fmt::format("\"{}\" is not of the form \"Section/Subsection/Entry "
                       "= value\"",
                       text));
    return {join(names, "/"),
            dealii::Utilities::trim(text.substr(equals + 1)),
            "--set"};
  }
} // namespace corotet
