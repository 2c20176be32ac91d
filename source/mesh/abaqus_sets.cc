// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The sets and surfaces of files of Abaqus.

#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>

#include "abaqus_reader.h"

namespace corotet::abaqus
{
  namespace
  {
    // The members of the range "first, last, increment". Numbers that do not
    // exist are skipped, as CalculiX does.
    std::vector<std::uint32_t>
    generated(const std::vector<std::string>                        &words,
              const std::unordered_map<std::int64_t, std::uint32_t> &known,
              const Place                                           &place)
    {
      if (words.size() < 2 || words.size() > 3)
        place.refuse(
          fmt::format("GENERATE needs first, last and increment: found "
                      "{} fields",
                      words.size()));
      const std::int64_t first = tag(words[0], place),
                         last  = tag(words[1], place),
                         increment =
                           words.size() > 2 ? tag(words[2], place) : 1;
      if (last < first)
        place.refuse(
          fmt::format("found the last number, {}, before the first one, "
                      "{}",
                      last,
                      first));
      std::vector<std::uint32_t> members;
      // Files may have thousands of short ranges, so a short range is not
      // compared with all numbers.
      const std::int64_t n_increments = (last - first) / increment;
      if (static_cast<std::size_t>(n_increments) < known.size())
        {
          for (std::int64_t k = 0; k <= n_increments; ++k)
            if (const auto one = known.find(first + k * increment);
                one != known.end())
              members.push_back(one->second);
          return members;
        }
      std::vector<std::pair<std::int64_t, std::uint32_t>> found;
      for (const auto &[number, index] : known)
        if (number >= first && number <= last &&
            (number - first) % increment == 0)
          found.emplace_back(number, index);
      std::sort(found.begin(), found.end());
      for (const auto &[number, index] : found)
        members.push_back(index);
      return members;
    }
  } // namespace



  const Scope &
  Reader::scope_of_members(const Place &place)
  {
    const std::string name = upper_case(keyword.value("INSTANCE"));
    if (name.empty())
      return current_scope();
    for (const Scope &scope : scopes)
      if (upper_case(scope.name) == name)
        return scope;
    place.refuse("there is no instance '" +
                 shortened(keyword.value("INSTANCE")) + "'");
  }



  std::vector<std::uint32_t> &
  Reader::target_of_set()
  {
    const std::string name           = keyword.needed(keyword.name);
    Scope            &scope          = current_scope();
    const bool        is_of_elements = keyword.name == "ELSET";
    if (keyword.has("INTERNAL"))
      (is_of_elements ? scope.internal_element_sets : scope.internal_node_sets)
        .insert(upper_case(name));
    return is_of_elements ? scope.element_sets[name] : scope.node_sets[name];
  }



  void
  Reader::begin_set()
  {
    std::vector<std::uint32_t> &target = target_of_set();
    if (keyword.name != "NSET" || !keyword.has("ELSET"))
      return;
    const Place       place  = keyword.place;
    const std::string name   = keyword.needed("ELSET");
    const auto [scope, what] = scope_and_name(name, place);
    const Model &of          = current_model();
    const auto  *elements    = scope->element_sets.find(what);
    if (elements == nullptr)
      place.refuse("there is no set of elements '" + shortened(name) +
                   "' before this line");
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t e : *elements)
      {
        const Element &element = of.elements[e];
        const auto     first   = of.element_nodes.begin() + element.first;
        spend(element.kind.n_nodes, place);
        nodes.insert(nodes.end(), first, first + element.kind.n_nodes);
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    target.insert(target.end(), nodes.begin(), nodes.end());
  }



  std::vector<std::uint32_t>
  Reader::members_of(const std::string &word, const Place &place)
  {
    const bool  of_elements = keyword.name == "ELSET";
    const auto *own         = of_elements ?
                                scope_of_members(place).element_sets.find(word) :
                                scope_of_members(place).node_sets.find(word);
    // Names of sets may contain a point, too.
    const auto [scope, name] = own != nullptr ?
                                 std::pair(&scope_of_members(place), word) :
                                 scope_and_name(word, place);
    const auto &known        = of_elements ? scope->elements : scope->nodes;
    const auto &sets = of_elements ? scope->element_sets : scope->node_sets;
    const std::string what = of_elements ? "element" : "node";
    if (const auto number = whole_number(name))
      {
        const auto found = known.find(*number);
        if (found == known.end() && of_elements)
          current_model().check_other_cells(path);
        if (found == known.end())
          place.refuse(fmt::format("there is no {} {} before this line",
                                   what,
                                   name == word ? name : shortened(word)));
        return {found->second};
      }
    const auto *set = sets.find(name);
    if (set == nullptr)
      place.refuse(fmt::format("there is no {} and no set of {}s "
                               "'{}' before this line",
                               what,
                               what,
                               shortened(word)));
    spend(set->size(), place);
    return *set;
  }



  void
  Reader::add_to_set(const std::vector<std::string> &words, const Place &place)
  {
    std::vector<std::uint32_t> members;
    if (keyword.has("GENERATE"))
      {
        const Scope &from = scope_of_members(place);
        members =
          generated(words,
                    keyword.name == "ELSET" ? from.elements : from.nodes,
                    place);
        spend(members.size(), place);
      }
    else
      for (const std::string &word : words)
        if (!word.empty())
          {
            const auto more = members_of(word, place);
            members.insert(members.end(), more.begin(), more.end());
          }
    std::vector<std::uint32_t> &target = target_of_set();
    target.insert(target.end(), members.begin(), members.end());
  }



  void
  Reader::begin_surface()
  {
    const std::string name = keyword.needed("NAME");
    const std::string type = upper_case(keyword.value("TYPE"));
    if (!type.empty() && type != "ELEMENT" && type != "NODE")
      keyword.place.refuse("found a surface of the type '" + shortened(type) +
                           "'; allowed are ELEMENT and NODE");
    if (type == "NODE")
      current_scope().node_sets[name];
    else
      current_scope().surfaces[name];
  }



  void
  Reader::add_to_surface(const std::vector<std::string> &words,
                         const Place                    &place)
  {
    if (words.empty())
      return;
    const std::string name   = keyword.needed("NAME");
    const auto [scope, what] = scope_and_name(words[0], place);
    const Scope &from        = *scope;
    const auto   number      = whole_number(what);
    if (upper_case(keyword.value("TYPE")) == "NODE")
      {
        const auto *set = from.node_sets.find(what);
        auto members    = set != nullptr ? *set : std::vector<std::uint32_t>();
        spend(members.size(), place);
        if (number)
          members.push_back(node_of(*number, from, place));
        else if (set == nullptr)
          place.refuse("there is no node and no set of nodes '" +
                       shortened(words[0]) + "' before this line");
        auto &target = current_scope().node_sets[name];
        target.insert(target.end(), members.begin(), members.end());
        return;
      }
    std::vector<std::uint32_t> members;
    if (const auto *set = from.element_sets.find(what))
      {
        spend(set->size(), place);
        members = *set;
      }
    else if (const auto found = from.elements.find(number.value_or(-1));
             found != from.elements.end())
      members.push_back(found->second);
    else
      place.refuse("there is no element and no set of elements '" +
                   shortened(words[0]) + "' before this line");
    const std::string face = words.size() > 1 ? upper_case(words[1]) : "";
    unsigned char     number_of_face = 0;
    if (face.size() == 2 && face[0] == 'S' && face[1] >= '1' && face[1] <= '4')
      number_of_face = face[1] - '0';
    else if (!face.empty() && face != "SPOS" && face != "SNEG")
      place.refuse("found the face '" + shortened(words[1]) +
                   "'; allowed are S1, S2, S3 and S4");
    auto &target = current_scope().surfaces[name];
    for (const std::uint32_t element : members)
      target.push_back({element, number_of_face});
  }



  std::pair<const Scope *, std::string>
  Reader::scope_and_name(const std::string &word, const Place &place)
  {
    if (keyword.has("INSTANCE"))
      return {&scope_of_members(place), word};
    const std::string key = upper_case(word);
    for (const Scope &scope : scopes)
      if (const std::string start = upper_case(scope.name) + ".";
          !scope.name.empty() && key.starts_with(start))
        return {&scope, word.substr(start.size())};
    return {&current_scope(), word};
  }



  void
  Reader::spend(const std::size_t n, const Place &place)
  {
    if (n > n_left)
      place.refuse("copies and sets of sets have more members than there is "
                   "room for; is the file damaged?");
    n_left -= n;
  }
} // namespace corotet::abaqus
