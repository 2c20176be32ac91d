// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/file_names.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/abaqus_file.h>

#include <fmt/format.h>

#include <fstream>

#include "abaqus_reader.h"

namespace corotet::abaqus
{
  namespace
  {
    namespace fs = std::filesystem;

    // Limits for files that include each other.
    constexpr unsigned int max_depth    = 20;
    constexpr unsigned int max_included = 1000;

    // Characters to remove around lines; quotes stay.
    constexpr const char *blanks = " \t\r";
  } // namespace



  Reader::Reader(const std::string &path)
    : folder(fs::absolute(path).parent_path())
    , path(path)
  {
    scopes.emplace_back();
    read(path, 0);
    finish_keyword();
    if (part != nullptr)
      part->place.refuse("found *PART without *END PART");
    if (instance)
      instance->place.refuse("found *INSTANCE without *END INSTANCE");
  }



  ImportedMesh
  Reader::mesh() const
  {
    ImportedMesh result = imported_mesh(model, scopes, path);
    result.remarks.insert(result.remarks.end(), remarks.begin(), remarks.end());
    if (!ignored.empty())
      result.remarks.push_back(
        "left out, as corotet reads the mesh only: " +
        shortened(join({ignored.begin(), ignored.end()}), 300));
    return result;
  }



  Model &
  Reader::current_model()
  {
    return part != nullptr ? part->model : model;
  }



  Scope &
  Reader::current_scope()
  {
    if (part != nullptr)
      return part->scope;
    return instance ? scopes.back() : scopes[0];
  }



  void
  Reader::read(const std::string &file, const unsigned int depth)
  {
    std::ifstream stream(file);
    if (!stream)
      throw MachineError(file + ": cannot be read (permission?)");
    skip_byte_order_mark(stream);
    std::string line;
    Place       place{file, 0};
    while (std::getline(stream, line))
      {
        ++place.line;
        // The limit of copies grows in proportion to what has been read.
        n_left += line.size();
        if (line.find('\0') != std::string::npos)
          place.refuse("found a byte of zero: is this a text file?");
        const std::string text = trimmed(line, blanks);
        if (text.empty() || text.starts_with("**"))
          continue;
        if (text[0] != '*')
          {
            add_data(text, place);
            continue;
          }
        std::string whole = text;
        const Place first = place;
        while (whole.back() == ',' && std::getline(stream, line))
          {
            ++place.line;
            const std::string more = trimmed(line, blanks);
            if (!more.starts_with("**"))
              whole += more;
          }
        const Keyword next = parse_keyword(whole, first);
        // The lines of the included file stand in place of this one; they may
        // be data of the present keyword.
        if (next.name == "INCLUDE")
          {
            read_other(next.needed("INPUT"), next.place, depth);
            continue;
          }
        finish_keyword();
        begin_keyword(next, depth);
      }
    check_read_to_end(stream, file);
  }



  void
  Reader::begin_keyword(const Keyword &next, const unsigned int depth)
  {
    keyword = next;
    // Rigid surfaces have a shape of their own, and no cells.
    static const std::set<std::string> rigid{"CYLINDER",
                                             "REVOLUTION",
                                             "SEGMENTS",
                                             "USER"};
    if (const std::string type = upper_case(keyword.value("TYPE"));
        keyword.name == "SURFACE" && rigid.contains(type))
      keyword.name += ", TYPE=" + type;
    if (instance && !instance->is_placed)
      place_instance();
    const std::string other = keyword.value("INPUT");
    if (keyword.name == "NODE")
      check_coordinates();
    else if (keyword.name == "SYSTEM" || keyword.name == "NGEN" ||
             keyword.name == "NCOPY" || keyword.name == "ELGEN" ||
             keyword.name == "ELCOPY" || keyword.name == "NFILL" ||
             keyword.name == "NMAP")
      keyword.place.refuse("found *" + keyword.name +
                           ", which is not supported; allowed are nodes "
                           "and elements that are written out");
    else if (keyword.name == "ELEMENT")
      begin_elements();
    else if (keyword.name == "PART")
      begin_part();
    else if (keyword.name == "END PART")
      end_part();
    else if (keyword.name == "INSTANCE")
      begin_instance();
    else if (keyword.name == "END INSTANCE")
      end_instance();
    else if (keyword.name == "ELSET" || keyword.name == "NSET")
      begin_set();
    else if (keyword.name == "SURFACE")
      begin_surface();
    else if (keyword.name != "ASSEMBLY" && keyword.name != "END ASSEMBLY" &&
             keyword.name != "HEADING" && keyword.name != "PREPRINT")
      ignored.insert("*" + keyword.name);
    // The data lines of these keywords may be in a file of their own.
    if (!other.empty() &&
        (keyword.name == "NODE" || keyword.name == "ELEMENT" ||
         keyword.name == "ELSET" || keyword.name == "NSET" ||
         keyword.name == "SURFACE"))
      read_other(other, keyword.place, depth);
  }



  void
  Reader::add_data(const std::string &line, const Place &place)
  {
    if (keyword.name == "NODE")
      add_node(fields(line), place);
    else if (keyword.name == "ELEMENT")
      add_element(line, place);
    else if (keyword.name == "ELSET" || keyword.name == "NSET")
      add_to_set(fields(line), place);
    else if (keyword.name == "SURFACE")
      add_to_surface(fields(line), place);
    else if (keyword.name == "INSTANCE" && instance)
      add_motion(fields(line), place);
    else if (keyword.name.empty())
      place.refuse("found '" + shortened(line) +
                   "' before the first keyword; needed is one like "
                   "*NODE");
  }



  void
  Reader::finish_keyword()
  {
    if (keyword.name == "ELEMENT" && !unfinished.empty())
      keyword.place.refuse(fmt::format(
        "the last element of this *ELEMENT has too few nodes: found {}; "
        "needed are {}",
        unfinished.size() - 1,
        kind.n_nodes));
    keyword.name.clear();
  }



  void
  Reader::read_other(const std::string &name,
                     const Place        place,
                     const unsigned int depth)
  {
    if (depth + 1 >= max_depth)
      place.refuse(fmt::format("found files that include each other {} "
                               "levels deep; do they include themselves?",
                               max_depth));
    if (++n_included > max_included)
      place.refuse(
        fmt::format("found more than {} included files", max_included));
    std::error_code error;
    const fs::path  file = fs::weakly_canonical(folder / name, error);
    const fs::path  inside =
      file.lexically_relative(fs::weakly_canonical(folder, error));
    if (inside.empty() || *inside.begin() == "..")
      place.refuse("found the file '" + shortened(name) +
                   "' outside of the folder of the first one; allowed "
                   "are files in it or below it");
    if (!fs::is_regular_file(file, error))
      place.refuse("there is no such file: found '" + shortened(name) + "'");
    // Messages name the file relative to the folder of the first one.
    read(file_in(fs::path(path).parent_path().string(), name), depth + 1);
  }



  void
  Reader::check_coordinates() const
  {
    const std::string system = upper_case(keyword.value("SYSTEM"));
    if (!system.empty() && system != "R")
      keyword.place.refuse("found the coordinate system '" + shortened(system) +
                           "'; allowed is R, rectangular");
  }



  void
  Reader::add_node(const std::vector<std::string> &words, const Place &place)
  {
    if (words.size() < 2 || words.size() > 7)
      place.refuse(fmt::format("a node is a number and three "
                               "coordinates: found {} fields",
                               words.size()));
    const std::int64_t number_of_node = tag(words[0], place);
    dealii::Point<3>   x;
    for (unsigned int d = 0; d < 3 && d + 1 < words.size(); ++d)
      if (!words[d + 1].empty())
        x[d] = number(words[d + 1], place);
    Model &to = current_model();
    Scope &of = current_scope();
    const auto [known, is_new] =
      of.nodes.emplace(number_of_node, to.nodes.size());
    if (is_new)
      to.nodes.push_back(x);
    else if (to.nodes[known->second] != x)
      place.refuse(fmt::format("node {} is there already, at another "
                               "place",
                               number_of_node));
    if (keyword.has("NSET"))
      of.node_sets[keyword.needed("NSET")].push_back(known->second);
  }



  void
  Reader::begin_elements()
  {
    const std::string type = upper_case(keyword.needed("TYPE"));
    kind                   = kind_of(type);
    unfinished.clear();
  }



  void
  Reader::add_element(const std::string &line, const Place &place)
  {
    const std::vector<std::string> words = fields(line);
    if (kind.shape == Shape::other)
      {
        // A line that ends with a comma is continued.
        if (!goes_on)
          ++current_model().others[upper_case(keyword.needed("TYPE"))];
        goes_on = line.back() == ',';
        return;
      }
    for (const std::string &word : words)
      unfinished.push_back(tag(word, place));
    if (unfinished.size() > kind.n_nodes + 1)
      place.refuse(
        fmt::format("an element of the type '{}' has {} nodes: found {}",
                    shortened(keyword.value("TYPE")),
                    kind.n_nodes,
                    unfinished.size() - 1));
    if (unfinished.size() < kind.n_nodes + 1)
      {
        if (line.back() != ',' && kind.n_nodes <= 6)
          place.refuse(
            fmt::format("an element of the type '{}' has {} nodes: found {}",
                        shortened(keyword.value("TYPE")),
                        kind.n_nodes,
                        unfinished.size() - 1));
        return;
      }
    Model        &to      = current_model();
    Scope        &of      = current_scope();
    const Element element = {kind, to.element_nodes.size()};
    for (unsigned int i = 1; i <= kind.n_nodes; ++i)
      to.element_nodes.push_back(node_of(unfinished[i], of, place));
    const auto [known, is_new] =
      of.elements.emplace(unfinished[0], to.elements.size());
    if (!is_new)
      place.refuse(fmt::format("element {} is there already", unfinished[0]));
    to.elements.push_back(element);
    if (keyword.has("ELSET"))
      of.element_sets[keyword.needed("ELSET")].push_back(known->second);
    unfinished.clear();
  }



  std::uint32_t
  Reader::node_of(const std::int64_t number,
                  const Scope       &scope,
                  const Place       &place)
  {
    const auto found = scope.nodes.find(number);
    if (found == scope.nodes.end())
      place.refuse(fmt::format("there is no node {} before this line", number));
    return found->second;
  }
} // namespace corotet::abaqus



namespace corotet
{
  ImportedMesh
  read_abaqus_file(const std::string &path)
  {
    return abaqus::Reader(path).mesh();
  }
} // namespace corotet
