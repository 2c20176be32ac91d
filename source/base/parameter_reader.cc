// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/parameter_reader.h>
#include <corotet/base/parameter_trees.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;

    using Statements = std::vector<ParameterStatement>;

    // Limits without which a file that includes itself would never end.
    constexpr unsigned int max_include_depth = 10;
    constexpr unsigned int max_includes      = 1000;

    // @p includer: the place of the including statement and ": ".
    std::ifstream
    open_file(const std::string &path, const std::string &includer = "")
    {
      std::error_code error;
      const auto      status = fs::status(path, error);
      std::ifstream   file;
      if (fs::is_regular_file(status))
        file.open(path);
      if (error == std::errc::permission_denied ||
          (fs::is_regular_file(status) && !file.is_open()))
        throw MachineError(includer + shortened(path) +
                           ": cannot be read (permission?)");
      if (status.type() == fs::file_type::not_found)
        refuse_statement(shortened(path), "there is no such file");
      if (error)
        refuse_statement(shortened(path), error.message());
      if (!fs::is_regular_file(status))
        refuse_statement(path, "it cannot be read as a file");
      if (const auto size = fs::file_size(path, error);
          !error && size > max_file_size)
        refuse_statement(path,
                         fmt::format("it has {} bytes; a parameter file may "
                                     "have {}",
                                     size,
                                     max_file_size));
      skip_byte_order_mark(file);
      return file;
    }

    // The rest of @p line behind @p keyword, or nothing if the line does not
    // start with this word. deal.II knows keywords in lower and in upper case.
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
      read(const std::string &path,
           const unsigned int depth    = 0,
           const std::string &includer = "")
      {
        std::ifstream     file        = open_file(path, includer);
        const std::size_t outer_depth = sections.size();
        lines_of_entries.emplace_back();
        std::string  line;
        std::string  concatenated;
        unsigned int number       = 0;
        unsigned int first_number = 1;
        while (std::getline(file, line))
          {
            ++number;
            check_zero_bytes(line, fmt::format("{}:{}", path, number));
            line = dealii::Utilities::trim(line);
            if (concatenated.empty())
              first_number = number;
            const bool continued = !line.empty() && line.back() == '\\';
            if (continued)
              line.pop_back();
            concatenated += line;
            if (continued && concatenated.find('#') != std::string::npos)
              refuse_statement(fmt::format("{}:{}", path, number),
                               "a comment ends with '\\', which would make the "
                               "next line a part of it");
            if (continued)
              continue;
            statement(concatenated, path, first_number, outer_depth, depth);
            concatenated.clear();
          }
        check_read_to_end(file, path);
        statement(concatenated, path, first_number, outer_depth, depth);
        if (sections.size() > outer_depth)
          refuse_statement(
            sections.back().second,
            fmt::format("subsection \"{}\" is opened here and never left; "
                        "an \"end\" is missing",
                        shortened(sections.back().first)));
        lines_of_entries.pop_back();
      }

      Statements statements;

    private:
      // Reads the assignment @p assignment, which stands behind "set" in @p
      // line.
      void
      assign(const std::string &line,
             const std::string &assignment,
             const unsigned int number,
             const std::string &place)
      {
        const std::size_t equals = assignment.find('=');
        const std::string name =
          dealii::Utilities::trim(assignment.substr(0, equals));
        if (equals == std::string::npos || name.empty())
          refuse_statement(
            place,
            fmt::format("\"{}\" is not of the form \"set Entry = "
                        "value\"",
                        shortened(line)));
        const std::string path = path_of(name);
        const auto [first, is_new] =
          lines_of_entries.back().emplace(path, number);
        if (!is_new)
          refuse_second(place,
                        path,
                        fmt::format(", first in line {}", first->second));
        add_statement(statements,
                      {path,
                       dealii::Utilities::trim(assignment.substr(equals + 1)),
                       place});
      }

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
              refuse_statement(place, "\"subsection\" without a name");
            if (sections.size() == max_section_depth)
              refuse_as_too_deep(place);
            sections.emplace_back(*name, place);
            add_statement(statements, {path_of(""), std::nullopt, place});
          }
        else if (const auto rest = behind_keyword(line, "end"))
          {
            if (!rest->empty())
              refuse_statement(
                place,
                fmt::format("\"{}\" behind \"end\"; nothing may follow",
                            shortened(*rest)));
            if (sections.size() == outer_depth)
              refuse_statement(
                place, "\"end\", but there is no subsection to leave here");
            sections.pop_back();
          }
        else if (const auto assignment = behind_keyword(line, "set"))
          assign(line, *assignment, number, place);
        else if (const auto included = behind_keyword(line, "include"))
          {
            if (include_depth == max_include_depth)
              refuse_statement(
                place,
                fmt::format("files include each other more than {} deep",
                            max_include_depth));
            if (++n_included > max_includes)
              refuse_statement(place,
                               fmt::format("more than {} files are included",
                                           max_includes));
            const fs::path  path = fs::path(file).parent_path() / *included;
            std::error_code error;
            const bool      is_file = fs::is_regular_file(path, error);
            if (!included->empty() && fs::is_directory(path, error))
              refuse_statement(
                place,
                fmt::format("the file to include, \"{}\", is a folder",
                            shortened(path.string())));
            if (included->empty() ||
                (!is_file && error != std::errc::permission_denied))
              refuse_statement(
                place,
                fmt::format("the file to include, \"{}\", does not exist",
                            shortened(path.string())));
            read(path.string(), include_depth + 1, place + ": ");
          }
        else
          refuse_statement(
            place,
            fmt::format("\"{}\" is no statement; allowed are \"set Entry = "
                        "value\", \"subsection Name\", \"end\" and "
                        "\"include FILE\"",
                        shortened(line)));
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

      // The names of the open subsections, and where they were opened.
      std::vector<std::pair<std::string, std::string>> sections;
      // The lines of the entries that each open file has set, to find entries
      // that one file sets twice. A file may set entries of an included file
      // again.
      std::vector<std::map<std::string, unsigned int>> lines_of_entries;
      unsigned int                                     n_included = 0;
    };
  } // namespace

  std::vector<ParameterStatement>
  read_parameter_statements(const std::string &path)
  {
    if (path.empty())
      throw InputError("", "no parameter file is given");
    const std::string ending = fs::path(path).extension().string();
    if (ending == ".json")
      {
        std::ifstream file = open_file(path);
        return read_json_statements(path, file);
      }
    if (ending == ".xml")
      {
        std::ifstream file = open_file(path);
        return read_xml_statements(path, file);
      }
    if (ending != ".prm" && fs::is_directory(path))
      refuse_statement(
        path, "found a folder; allowed are files .prm, .json and .xml");
    if (ending.empty() && fs::is_regular_file(path + ".prm"))
      refuse_statement(path,
                       "there is no such parameter file; do you mean '" +
                         shortened(path + ".prm") + "'?");
    if (ending != ".prm")
      refuse_statement(
        path,
        fmt::format("a parameter file cannot end in \"{}\"; allowed are "
                    ".prm, .json and .xml",
                    shortened(ending)));
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
      refuse_statement(
        "--set",
        fmt::format("\"{}\" is not of the form \"Section/Subsection/Entry "
                    "= value\"",
                    shortened(text)));
    return {join(names, "/"),
            dealii::Utilities::trim(text.substr(equals + 1)),
            "--set"};
  }
} // namespace corotet
