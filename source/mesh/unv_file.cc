// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Universal files of I-deas.

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <unordered_map>

#include "abaqus_lines.h"
#include "model_builder.h"

namespace corotet
{
  namespace
  {
    // gmsh's type of elements, and theirs in our order.
    struct UnvType
    {
      int              gmsh;
      std::vector<int> order;
    };



    // By I-deas's number and that of the nodes. Those on edges stand between
    // the corners.
    std::optional<UnvType>
    unv_type(const std::int64_t number, const std::int64_t n_nodes)
    {
      static const std::set<std::int64_t> lines{11, 21, 22, 23, 24, 31, 32},
        triangles{41, 42, 51, 52, 61, 62, 72, 74, 81, 82, 91, 92};
      if (number == 111 && n_nodes == 4)
        return UnvType{4, {0, 1, 2, 3}};
      if (number == 118 && n_nodes == 10)
        return UnvType{11, {0, 2, 4, 9, 1, 3, 5, 6, 8, 7}};
      if (triangles.contains(number) && n_nodes == 3)
        return UnvType{2, {0, 1, 2}};
      if (triangles.contains(number) && n_nodes == 6)
        return UnvType{9, {0, 2, 4, 1, 3, 5}};
      if (lines.contains(number) && n_nodes == 2)
        return UnvType{1, {0, 1}};
      if (lines.contains(number) && n_nodes == 3)
        return UnvType{8, {0, 2, 1}};
      return {};
    }



    class UnvReader
    {
    public:
      explicit UnvReader(const std::string &path)
        : place{path, 0}
        , file(path)
      {
        if (!file)
          throw MachineError(path + ": cannot be read (permission?)");
        skip_byte_order_mark(file);
        while (next())
          {
            if (trimmed_line() != "-1" || !next())
              continue;
            const std::string dataset = trimmed_line();
            if (dataset == "15")
              read_nodes_in_lines();
            else if (dataset == "781" || dataset == "2411")
              read_nodes();
            else if (dataset == "780" || dataset == "2412")
              read_elements();
            else if (dataset == "2467" || dataset == "2477" ||
                     dataset == "2452")
              read_groups(4);
            else if (dataset == "2429" || dataset == "2430" ||
                     dataset == "2432" || dataset == "2435")
              read_groups(2);
            else
              while (next() && trimmed_line() != "-1")
                ;
          }
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
        result.remark = join(remarks, "; ");
        return result;
      }

    private:
      bool
      next()
      {
        ++place.line;
        return static_cast<bool>(std::getline(file, line));
      }

      std::string
      trimmed_line() const
      {
        return abaqus::trimmed(line);
      }

      // A line that has to be there.
      std::vector<std::string>
      needed_words()
      {
        if (!next())
          place.refuse("the file ends within a dataset: is the rest missing?");
        return words();
      }

      std::vector<std::string>
      words() const
      {
        std::istringstream       stream(line);
        std::vector<std::string> result;
        for (std::string word; stream >> word;)
          result.push_back(word);
        return result;
      }

      // The next line of a dataset; none at its end.
      std::optional<std::vector<std::string>>
      record()
      {
        auto result = needed_words();
        if (result == std::vector<std::string>{"-1"})
          return {};
        return result;
      }

      std::int64_t
      whole(const std::vector<std::string> &of_line, const std::size_t i) const
      {
        const auto result =
          i < of_line.size() ? abaqus::whole_number(of_line[i]) : std::nullopt;
        if (!result)
          place.refuse(fmt::format(
            "a whole number is expected as word {} of the line: found '{}'",
            i + 1,
            i < of_line.size() ? shortened(of_line[i], 40) : ""));
        return *result;
      }

      std::uint64_t
      positive(const std::vector<std::string> &of_line,
               const std::size_t               i) const
      {
        const std::int64_t result = whole(of_line, i);
        if (result < 1 || result > INT_MAX)
          place.refuse(
            fmt::format("found {}; allowed is a positive whole number",
                        result));
        return result;
      }

      void
      add_node(const std::uint64_t             label,
               const std::vector<std::string> &coordinates,
               const std::size_t               first)
      {
        if (coordinates.size() < first + 3)
          place.refuse(fmt::format("a node has three coordinates: found {}",
                                   coordinates.size() - first));
        builder.add_node(label,
                         {abaqus::number(coordinates[first], place),
                          abaqus::number(coordinates[first + 1], place),
                          abaqus::number(coordinates[first + 2], place)});
      }

      void
      read_nodes_in_lines()
      {
        while (const auto of_line = record())
          {
            const std::uint64_t label = positive(*of_line, 0);
            if (of_line->size() < 7)
              place.refuse("a node has four whole numbers and three "
                           "coordinates: found '" +
                           shortened(line) + "'");
            add_node(label, *of_line, 4);
          }
      }

      void
      read_nodes()
      {
        while (const auto of_line = record())
          {
            const std::uint64_t label = positive(*of_line, 0);
            add_node(label, needed_words(), 0);
          }
      }

      void
      read_elements()
      {
        while (const auto head = record())
          {
            const std::uint64_t label   = positive(*head, 0);
            const std::int64_t  type    = whole(*head, 1);
            const std::int64_t  n_nodes = whole(*head, head->size() - 1);
            const bool          is_long = head->size() >= 8;
            const Numbers       numbers{
                    {whole(*head, is_long ? 4 : 3), whole(*head, 2)}};
            if (n_nodes < 1 || n_nodes > 1000)
              place.refuse(
                fmt::format("found an element with {} nodes", n_nodes));
            const auto known = unv_type(type, n_nodes);
            // Wedges, bricks, pyramids, and tetrahedra of other degrees.
            if (!known && type > 100 && type < 120)
              place.refuse(fmt::format(
                "cells other than tetrahedra with 4 or 10 nodes: found the "
                "type {} with {} nodes; allowed are 111 and 118",
                type,
                n_nodes));
            // Beams say how they are turned.
            static const std::set<std::int64_t> beams{
              11, 21, 22, 23, 24, 31, 32};
            if (beams.contains(type))
              needed_words();
            std::vector<std::uint64_t> theirs, nodes;
            while (theirs.size() < std::size_t(n_nodes))
              {
                const auto of_line = needed_words();
                if (of_line.empty())
                  place.refuse("found no nodes of an element");
                for (std::size_t i = 0; i < of_line.size(); ++i)
                  theirs.push_back(positive(of_line, i));
              }
            if (!known)
              {
                ++n_others[type];
                continue;
              }
            for (const int i : known->order)
              nodes.push_back(theirs[i]);
            elements[label] = builder.add_element(known->gmsh, nodes);
            numbers_of.push_back(numbers);
          }
      }

      // @p n_numbers for each member: 8 and the label for elements, 7 for
      // nodes.
      void
      read_groups(const std::size_t n_numbers)
      {
        while (const auto head = record())
          {
            std::int64_t n = whole(*head, head->size() - 1);
            next();
            const int group = groups.size();
            groups.push_back(trimmed_line());
            if (groups.back().empty())
              groups.back() = "group " + (*head)[0];
            while (n > 0)
              {
                const auto of_line = needed_words();
                if (of_line.size() < n_numbers)
                  place.refuse(
                    fmt::format("{} more members of the group '{}' are "
                                "expected: found '{}'",
                                n,
                                shortened(groups.back(), 40),
                                shortened(line, 40)));
                for (std::size_t i = 0;
                     i + n_numbers <= of_line.size() && n > 0;
                     i += n_numbers, --n)
                  members.push_back(
                    {group, whole(of_line, i), whole(of_line, i + 1)});
              }
          }
      }

      // Which numbers are those of a group, after all datasets.
      void
      add_numbers()
      {
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

      // Of the material and of the physical property.
      using Numbers = std::array<std::int64_t, 2>;

      struct Member
      {
        int          group;
        std::int64_t kind, label;
      };

      abaqus::Place place;
      std::ifstream file;
      std::string   line;
      ModelBuilder  builder;
      // By their labels.
      std::unordered_map<std::int64_t, std::size_t> elements;
      std::vector<Numbers>                          numbers_of;
      std::vector<std::string>                      groups;
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
