// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Universal files of I-deas.

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <optional>
#include <set>
#include <unordered_map>

#include "model_builder.h"
#include "unv_lines.h"
#include "unv_types.h"

namespace corotet
{
  namespace
  {
    // A coordinate system in which nodes were defined: how many nodes, and the
    // line of the first one.
    struct UnvSystem
    {
      std::size_t   n_nodes = 0;
      abaqus::Place place;
    };



    class UnvReader
    {
    public:
      explicit UnvReader(const std::string &path)
        : lines(path)
      {
        while (lines.next())
          {
            if (lines.trimmed() != "-1" || !lines.next())
              continue;
            const std::string dataset = lines.trimmed();
            if (dataset == "15")
              read_nodes_in_lines();
            else if (dataset == "781" || dataset == "2411")
              read_nodes(dataset == "781");
            else if (dataset == "780" || dataset == "2412")
              read_elements();
            else if (dataset == "2435" || dataset == "2452" ||
                     dataset == "2467" || dataset == "2477")
              read_groups(4);
            else if (dataset == "2429" || dataset == "2430" ||
                     dataset == "2432")
              read_groups(2);
            else
              {
                if (dataset == "18" || dataset == "2420")
                  has_systems = true;
                while (lines.next() && lines.trimmed() != "-1")
                  ;
              }
          }
        check_systems();
        add_numbers();
      }

      GmshModel
      model() const
      {
        GmshModel                result = builder.model();
        std::vector<std::string> remarks;
        for (const auto &[type, n] : n_others)
          remarks.push_back(
            fmt::format("{} elements of the type {} are left out", n, type));
        if (n_unknown > 0)
          remarks.push_back(fmt::format(
            "{} members of groups, of nodes or of elements that are not read, "
            "are left out",
            n_unknown));
        for (const auto &[number, system] : systems)
          remarks.push_back(
            fmt::format("coordinates of {} nodes are taken for global: the "
                        "file does not define their system, {}",
                        system.n_nodes,
                        number));
        result.remark = join(remarks, "; ");
        return result;
      }

    private:
      void
      add_node(const std::uint64_t             label,
               const std::vector<std::string> &coordinates,
               const std::size_t               first)
      {
        const abaqus::Place &place = lines.place;
        if (coordinates.size() < first + 3)
          place.refuse(fmt::format("a node has three coordinates: found {}",
                                   coordinates.size() - first));
        if (!builder.add_node(label,
                              {abaqus::number(coordinates[first], place),
                               abaqus::number(coordinates[first + 1], place),
                               abaqus::number(coordinates[first + 2], place)}))
          place.refuse(
            fmt::format("node {} is there already, at another place", label));
      }

      // Counts a node's system. 0 and 1 are the global one.
      void
      add_system(const std::vector<std::string> &of_line)
      {
        const std::int64_t number = lines.whole(of_line, 1);
        if (number == 0 || number == 1)
          return;
        UnvSystem &system = systems[number];
        if (++system.n_nodes == 1)
          system.place = lines.place;
      }

      // Called after all datasets, as systems may be defined behind the nodes.
      void
      check_systems() const
      {
        if (has_systems && !systems.empty())
          systems.begin()->second.place.refuse(fmt::format(
            "coordinates in a system of their own are not read: found the "
            "definition system {} of a node; allowed are 0 and 1, the global "
            "one",
            systems.begin()->first));
      }

      void
      read_nodes_in_lines()
      {
        while (const auto of_line = lines.record())
          {
            const std::uint64_t label = lines.positive(*of_line, 0);
            if (of_line->size() < 7)
              lines.place.refuse("a node has four whole numbers and three "
                                 "coordinates: found '" +
                                 shortened(lines.text()) + "'");
            add_system(*of_line);
            add_node(label, *of_line, 4);
          }
      }

      // In dataset 2411 the system is that of the export, and coordinates are
      // global.
      void
      read_nodes(const bool have_system)
      {
        while (const auto of_line = lines.record())
          {
            const std::uint64_t label = lines.positive(*of_line, 0);
            if (have_system)
              add_system(*of_line);
            add_node(label, lines.needed_words(), 0);
          }
      }

      // The head of an element is its label, type, physical property,
      // material, colour and number of nodes; in the dataset 780 the property
      // and the material have two numbers each, of which the second counts.
      void
      read_elements()
      {
        while (const auto head = lines.record())
          {
            if (head->size() != 6 && head->size() != 8)
              lines.place.refuse(fmt::format(
                "the first line of an element has 6 numbers, or 8 in the "
                "dataset 780: found '{}'",
                shortened(lines.text())));
            const std::uint64_t label   = lines.positive(*head, 0);
            const std::int64_t  type    = lines.whole(*head, 1);
            const std::int64_t  n_nodes = lines.whole(*head, head->size() - 1);
            const bool          is_long = head->size() == 8;
            const Numbers       numbers{{lines.whole(*head, is_long ? 5 : 3),
                                         lines.whole(*head, is_long ? 3 : 2)}};
            if (n_nodes < 1 || n_nodes > 1000)
              lines.place.refuse(
                fmt::format("found an element with {} nodes", n_nodes));
            const auto known = unv_type(type, n_nodes);
            // Wedges, bricks, pyramids, and tetrahedra of other degrees.
            if (!known && type > 100 && type < 120)
              lines.place.refuse(fmt::format(
                "cells other than tetrahedra with 4 or 10 nodes: found the "
                "type {} with {} nodes; allowed are 111 and 118",
                type,
                n_nodes));
            if (known && !elements.emplace(label, elements.size()).second)
              lines.place.refuse(
                fmt::format("element {} is there already", label));
            const auto theirs = nodes_of_element(type, n_nodes);
            if (!known)
              {
                ++n_others[type];
                continue;
              }
            std::vector<std::uint64_t> nodes;
            for (const int i : known->order)
              nodes.push_back(theirs[i]);
            builder.add_element(known->gmsh, nodes);
            numbers_of.push_back(numbers);
          }
      }

      std::vector<std::uint64_t>
      nodes_of_element(const std::int64_t type, const std::size_t n)
      {
        // Beams have a line about their orientation.
        static const std::set<std::int64_t> beams{11, 21, 22, 23, 24, 31, 32};
        if (beams.contains(type))
          lines.needed_words();
        std::vector<std::uint64_t> result;
        while (result.size() < n)
          {
            const auto of_line = lines.needed_words();
            if (of_line.empty())
              lines.place.refuse("found no nodes of an element");
            for (std::size_t i = 0; i < of_line.size(); ++i)
              result.push_back(lines.positive(of_line, i));
          }
        if (result.size() > n)
          lines.place.refuse(fmt::format(
            "an element of {} nodes: found {} of them", n, result.size()));
        return result;
      }

      // A member has @p n_numbers: elements are of type 8 and have a label;
      // nodes are of type 7.
      void
      read_groups(const std::size_t n_numbers)
      {
        while (const auto head = lines.record())
          {
            const auto numbers = whole_numbers(*head);
            if (numbers.size() != 8 || numbers.back() < 0)
              lines.place.refuse(
                fmt::format("the first line of a group has 8 numbers, the "
                            "number of members last: found '{}'",
                            shortened(lines.text(), 80)));
            std::int64_t n = numbers.back();
            lines.need_next();
            check_name(n_numbers);
            const int group = groups.size();
            groups.push_back(lines.trimmed());
            if (groups.back().empty())
              {
                unnamed_groups.insert(group);
                groups.back() = "group " + (*head)[0];
              }
            while (n > 0)
              {
                const auto         of_line   = lines.needed_words();
                const std::int64_t n_of_line = of_line.size() / n_numbers;
                if (n_of_line == 0 || of_line.size() % n_numbers != 0)
                  lines.place.refuse(
                    fmt::format("{} more members of the group '{}' are "
                                "expected: found '{}'",
                                n,
                                shortened(groups.back(), 40),
                                shortened(lines.text(), 40)));
                if (n_of_line > n)
                  lines.place.refuse(
                    fmt::format("the group '{}' has {} members by its first "
                                "line: found more",
                                shortened(groups.back(), 40),
                                numbers.back()));
                for (std::int64_t i = 0; i < n_of_line; ++i)
                  members.push_back({group,
                                     lines.whole(of_line, i * n_numbers),
                                     lines.whole(of_line, i * n_numbers + 1)});
                n -= n_of_line;
              }
          }
      }

      // The numbers in @p words; none if one word is not a whole number.
      static std::vector<std::int64_t>
      whole_numbers(const std::vector<std::string> &words)
      {
        std::vector<std::int64_t> result;
        for (const std::string &word : words)
          if (const auto number = abaqus::whole_number(word))
            result.push_back(*number);
        if (result.size() < words.size())
          result.clear();
        return result;
      }

      // Throws if a member, the next group or the end of the dataset stands in
      // place of a name: the number of members before is too small.
      void
      check_name(const std::size_t n_numbers) const
      {
        const auto numbers = whole_numbers(lines.words());
        const bool is_member =
          !numbers.empty() && numbers.size() % n_numbers == 0 &&
          (numbers.size() == 8 || numbers[0] == 7 || numbers[0] == 8);
        // A group may be called "-1", too.
        const bool is_end = lines.trimmed() == "-1" && lines.text()[0] == ' ';
        if (is_member || is_end)
          lines.place.refuse(fmt::format(
            "the name of a group is expected: found '{}'; is the number of "
            "members of the group before too small?",
            shortened(lines.trimmed(), 80)));
      }

      // A group without a name gets another one if its default name is taken.
      void
      name_unnamed_groups()
      {
        for (const std::size_t group : unnamed_groups)
          groups[group] =
            unused_name(groups[group], [&](const std::string &name) {
              return std::ranges::count(groups, name) >
                     (name == groups[group] ? 1 : 0);
            });
      }

      // Assigns the numbers of the groups, after all datasets.
      void
      add_numbers()
      {
        name_unnamed_groups();
        int first = 1;
        for (const Numbers &numbers : numbers_of)
          for (const std::int64_t number : numbers)
            if (number >= 0 && number < INT_MAX / 2)
              first = std::max(first, static_cast<int>(number) + 1);
        for (const auto &[group, kind, label] : members)
          {
            const auto element = elements.find(label);
            if (kind != 8 || element == elements.end())
              {
                ++n_unknown;
                continue;
              }
            builder.add_to_group(element->second, first + group);
            builder.name_group(builder.dimension(element->second),
                               first + group,
                               groups[group]);
          }
        for (const int dimension : {2, 3})
          {
            std::set<std::int64_t> materials;
            for (std::size_t e = 0; e < builder.n_elements(); ++e)
              if (builder.dimension(e) == dimension)
                materials.insert(numbers_of[e][0]);
            for (std::size_t e = 0; e < builder.n_elements(); ++e)
              if (builder.dimension(e) == dimension && !builder.has_group(e))
                {
                  const std::int64_t number =
                    numbers_of[e][materials.size() > 1 ? 0 : 1];
                  builder.add_to_group(e,
                                       number >= 0 && number < INT_MAX / 2 ?
                                         static_cast<int>(number) :
                                         0);
                }
          }
      }

      // The numbers of the material and of the physical property.
      using Numbers = std::array<std::int64_t, 2>;

      struct Member
      {
        int          group;
        std::int64_t kind, label;
      };

      UnvLines     lines;
      ModelBuilder builder;
      // The definition systems of nodes, and whether the file defines any.
      std::map<std::int64_t, UnvSystem> systems;
      bool                              has_systems = false;
      // The elements by their labels.
      std::unordered_map<std::int64_t, std::size_t> elements;
      std::vector<Numbers>                          numbers_of;
      std::vector<std::string>                      groups;
      std::set<std::size_t>                         unnamed_groups;
      std::vector<Member>                           members;
      std::map<std::int64_t, std::size_t>           n_others;
      std::size_t                                   n_unknown = 0;
    };
  } // namespace



  GmshModel
  read_unv(const std::string &path)
  {
    return UnvReader(path).model();
  }
} // namespace corotet
