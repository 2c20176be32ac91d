// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/parameter_file.h>
#include <corotet/base/parameter_listing.h>
#include <corotet/base/parameter_schema.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <sstream>
#include <system_error>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;

    using Json = nlohmann::ordered_json;

    [[noreturn]] void
    fail(const ParameterStatement &statement, const std::string &message)
    {
      throw InputError("", statement.place + ": " + message);
    }

    std::vector<std::string>
    split(const std::string &path)
    {
      return dealii::Utilities::split_string_list(path, '/');
    }

    // The sections that have an entry or subsection called @p name.
    void
    find_sections_with(const std::string        &name,
                       const Json               &section,
                       const std::string        &path,
                       std::vector<std::string> &found)
    {
      for (const auto &[key, node] : section.items())
        {
          if (key == name)
            found.push_back(path.empty() ? "the top level" :
                                           "\"" + path + "\"");
          if (node.is_object() && is_section(node))
            find_sections_with(name,
                               node,
                               path.empty() ? key : path + "/" + key,
                               found);
        }
    }

    // The message that @p section, at @p path, has nothing called @p name.
    std::string
    unknown_name_message(const std::string &name,
                         const bool         is_section_name,
                         const Json        &section,
                         const std::string &path,
                         const Json        &root)
    {
      std::vector<std::string> names;
      for (const auto &[key, node] : section.items())
        if (is_section(node) == is_section_name)
          names.push_back(key);
      const std::string kind = is_section_name ? "subsection" : "entry";
      const std::string message =
        fmt::format("there is no {} \"{}\" {}",
                    kind,
                    shortened(name),
                    path.empty() ? "at the top level" : "in \"" + path + "\"");

      const std::string suggestion = nearest(name, names);
      if (!suggestion.empty())
        return fmt::format("{}; did you mean \"{}\"?", message, suggestion);
      std::vector<std::string> elsewhere;
      find_sections_with(name, root, "", elsewhere);
      if (!elsewhere.empty())
        return fmt::format("{}; it belongs to {}",
                           message,
                           join(elsewhere, " or "));
      return fmt::format("{}; {}",
                         message,
                         names.empty() ? "it has none" :
                                         "allowed are " + join(names));
    }

    // The declared node that @p statement is about.
    const Json &
    find_node(const ParameterStatement &statement, const Json &root)
    {
      const Json              *node = &root;
      std::string              path;
      std::vector<std::string> names = split(statement.path);
      for (std::size_t i = 0; i < names.size(); ++i)
        {
          const bool needs_section =
            i + 1 < names.size() || !statement.value.has_value();
          if (!node->contains(names[i]))
            fail(
              statement,
              unknown_name_message(names[i], needs_section, *node, path, root));
          node = &node->at(names[i]);
          if (needs_section && !is_section(*node))
            fail(statement,
                 fmt::format("\"{}\" is an entry, not a subsection",
                             shortened(names[i])));
          if (!needs_section && is_section(*node) && !statement.may_be_section)
            fail(statement,
                 fmt::format("\"{}\" is a subsection, not an entry",
                             shortened(names[i])));
          path += (path.empty() ? "" : "/") + names[i];
        }
      return *node;
    }

    // A value must survive being written to a .prm file and read again, and
    // being listed as JSON.
    void
    check_text(const ParameterStatement &statement)
    {
      const std::string &value = *statement.value;
      if (value.find_first_of("#\n\r") != std::string::npos ||
          (!value.empty() && value.back() == '\\'))
        fail(statement,
             fmt::format("the value of \"{}\" has a #, a line break or a "
                         "backslash at its end; a parameter cannot have these",
                         statement.path));
      try
        {
          Json(value).dump();
        }
      catch (const Json::exception &)
        {
          fail(statement,
               fmt::format("the value of \"{}\" is not encoded in UTF-8",
                           statement.path));
        }
    }

    // The message that the value of @p statement does not match the pattern of
    // the entry @p node.
    std::string
    refused_value_message(const ParameterStatement &statement, const Json &node)
    {
      const std::string pattern = node.value("pattern_description", "");
      const std::string message =
        fmt::format("the value \"{}\" of \"{}\" is not allowed; allowed is {}",
                    shortened(*statement.value),
                    statement.path,
                    allowed_instead(*statement.value, pattern));
      const std::string suggestion =
        nearest(*statement.value, selection_names(pattern));
      return suggestion.empty() ?
               message :
               fmt::format("{}; did you mean \"{}\"?", message, suggestion);
    }

    // Whether a .prm file gives back this text, in which none of the
    // @p separators may be.
    bool
    can_be_written(const std::string &text, const std::string &separators)
    {
      try
        {
          Json(text).dump();
        }
      catch (const Json::exception &)
        {
          return false;
        }
      return text.find_first_of("#\n\r\t" + separators) == std::string::npos &&
             dealii::Utilities::trim(text) == text &&
             (text.empty() || text.back() != '\\');
    }

    // Makes file names that are relative to the folder @p from relative to the
    // folder @p to.
    class MovedFiles
    {
    public:
      MovedFiles(const fs::path &from, const fs::path &to)
        : from(from)
        , to(to)
      {}

      // Changes the values of entries that are a file name, or a list "key:
      // file name", in the section with this @p path, which ends with a slash
      // if it is not empty. Throws InputError if a .prm file cannot contain a
      // new name.
      void
      move(Json &section, const std::string &path = "") const
      {
        for (const auto &[key, node] : section.items())
          if (is_entry(node))
            node["value"] = moved_value(node, path + key);
          else if (node.is_object())
            move(node, path + key + "/");
      }

    private:
      std::string
      moved_value(const Json &node, const std::string &entry) const
      {
        const std::string value   = node.at("value");
        const std::string pattern = node.value("pattern_description", "");
        if (pattern.starts_with("[FileName"))
          return moved_name(value, entry, "");
        if (!pattern.starts_with("[Map of <[Anything]>:<[FileName"))
          return value;
        std::vector<std::string> items;
        for (const std::string &item :
             dealii::Utilities::split_string_list(value, ','))
          {
            const auto pair = dealii::Utilities::split_string_list(item, ':');
            AssertDimension(pair.size(), 2);
            items.push_back(pair[0] + ": " + moved_name(pair[1], entry, ",:"));
          }
        return join(items);
      }

      std::string
      moved_name(const std::string &file,
                 const std::string &entry,
                 const std::string &separators) const
      {
        const fs::path name = file;
        if (name.empty() || name.is_absolute())
          return file;
        // Files that cannot be accessed are refused where they are read.
        std::error_code error;
        fs::path        moved = fs::relative(from / name, to, error);
        if (error)
          moved = (from / name).lexically_relative(to);
        const std::string result = moved.string();
        if (!can_be_written(result, separators))
          throw InputError(
            entry,
            fmt::format("found '{}', which is '{}' as seen from the results, "
                        "what parameters.prm there, which repeats the run, "
                        "cannot say; allowed are folders whose names are text "
                        "in UTF-8 without #{}, tabs and line breaks",
                        file,
                        shortened(result),
                        separators.empty() ? "" : ", comma, colon"));
        return result;
      }

      const fs::path from;
      const fs::path to;
    };
  } // namespace

  void
  ParameterFile::read(const std::string              &path,
                      const std::vector<std::string> &overrides,
                      const MPI_Comm                  comm)
  {
    file                = path;
    const Json declared = tree();
    const auto statements =
      from_root(comm, [&] { return read_parameter_statements(path); });
    for (const ParameterStatement &statement : statements)
      apply(statement, declared);
    for (const std::string &text : overrides)
      apply(parse_override(text), declared);
  }

  void
  ParameterFile::apply(const ParameterStatement &statement,
                       const Json               &declared)
  {
    const Json &node       = find_node(statement, declared);
    places[statement.path] = statement.place;
    if (!statement.value || is_section(node))
      return;
    check_text(statement);

    std::vector<std::string> sections = split(statement.path);
    const std::string        entry    = sections.back();
    sections.pop_back();
    for (const std::string &section : sections)
      prm.enter_subsection(section);
    bool accepted = true;
    try
      {
        prm.set(entry, *statement.value);
      }
    catch (const dealii::ExceptionBase &)
      {
        accepted = false;
      }
    for (std::size_t i = 0; i < sections.size(); ++i)
      prm.leave_subsection();
    if (!accepted)
      fail(statement, refused_value_message(statement, node));
  }

  std::string
  ParameterFile::location(const std::string &entry) const
  {
    const auto place = places.find(entry);
    return place == places.end() ? file : place->second;
  }

  std::string
  ParameterFile::folder() const
  {
    const std::string parent = fs::path(file).parent_path().string();
    return parent.empty() ? "." : parent;
  }

  void
  ParameterFile::print(std::ostream &out, const std::string &style) const
  {
    if (style == "json")
      print_json(tree(), out);
    else if (style == "markdown")
      print_markdown(tree(), out);
    else if (style == "schema")
      print_schema(tree(), out);
    else
      {
        Assert(style == "prm", dealii::ExcMessage("Unknown style " + style));
        print_prm(tree(), /* documented = */ true, out);
      }
  }

  void
  ParameterFile::check_effective(const std::string &path) const
  {
    entries_for(path);
  }

  void
  ParameterFile::write_effective(const std::string &path) const
  {
    // The file is written as a whole, since a restart compares its parameters
    // with it: an incomplete file would look like that of another run.
    std::ostringstream text;
    print_prm(entries_for(path), /* documented = */ false, text);
    write_whole_file(path, text.str(), "the parameters");
  }

  nlohmann::ordered_json
  ParameterFile::entries_for(const std::string &path) const
  {
    Json entries = tree();
    MovedFiles(fs::absolute(folder()), fs::absolute(path).parent_path())
      .move(entries);
    return entries;
  }

  nlohmann::ordered_json
  ParameterFile::values() const
  {
    Json                                      result   = tree();
    const std::function<void(Json & section)> simplify = [&](Json &section) {
      for (const auto &[key, node] : section.items())
        if (is_entry(node))
          node = Json(node.at("value"));
        else if (node.is_object())
          simplify(node);
    };
    simplify(result);
    return result;
  }

  nlohmann::ordered_json
  ParameterFile::tree() const
  {
    std::ostringstream text;
    prm.print_parameters(text,
                         dealii::ParameterHandler::JSON |
                           dealii::ParameterHandler::KeepDeclarationOrder);
    Json result = Json::parse(text.str());
    return result.is_object() ? result : Json::object();
  }
} // namespace corotet
