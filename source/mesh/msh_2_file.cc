// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// gmsh's files of version 2.

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

#include "model_builder.h"
#include "msh_numbers.h"

namespace corotet
{
  namespace
  {
    class Msh2Reader
    {
    public:
      Msh2Reader(const std::string &path,
                 const bool         zero_is_group,
                 const std::string &origin)
        : zero_is_group(zero_is_group)
        , file(path, origin.empty() ? path : origin)
      {
        for (std::string section = file.next_section(); !section.empty();
             section             = file.next_section())
          {
            if (section == "MeshFormat")
              file.read_format();
            else if (section == "PhysicalNames")
              read_names();
            else if (section == "Nodes" || section == "ParametricNodes")
              read_nodes(section == "ParametricNodes");
            else if (section == "Elements")
              read_elements();
            else
              {
                file.skip_section(section);
                continue;
              }
            file.end_section(section);
          }
        sort_by_entity();
        builder.join_copies();
      }

      GmshModel
      model() const
      {
        GmshModel result = builder.model();
        if (partitions.size() == 1 &&
            (*partitions.begin() > 1 || all_partitions.size() > 1))
          result.only_partition = *partitions.begin();
        else if (partitions.size() == 1)
          result.remark = "warning: all cells are of partition 1: is this the "
                          "whole mesh, or one of several files?";
        return result;
      }

    private:
      std::int64_t
      size_of_section(const std::string &what)
      {
        const auto n = file.number<std::int64_t>();
        if (n < 0)
          file.refuse(fmt::format("found {} {}", n, what));
        file.rest_of_line();
        return n;
      }

      // Reads the names of groups. Their dimension is there from version 2.1
      // on.
      void
      read_names()
      {
        for (auto n = size_of_section("names"); n > 0; --n)
          {
            file.skip_blanks();
            const std::string  line  = file.rest_of_line();
            const std::size_t  quote = line.find('"'), end = line.rfind('"');
            std::istringstream words(line.substr(0, quote));
            std::vector<int>   numbers{std::istream_iterator<int>(words), {}};
            if (quote == end || end == std::string::npos || numbers.empty() ||
                numbers.size() > 2 || numbers[0] < 0 || numbers.back() < 0)
              file.refuse_line(
                fmt::format("found '{}'; allowed is the dimension, the number "
                            "and the name of a physical group: '3 1 \"body\"'",
                            shortened(line)));
            for (int dimension = 0; dimension < 4; ++dimension)
              if (numbers.size() == 1 || numbers[0] == dimension)
                builder.name_group(dimension,
                                   numbers.back(),
                                   line.substr(quote + 1, end - quote - 1));
          }
      }

      // The number of a node, which may exceed 32 bits in text.
      std::int64_t
      node_number()
      {
        return file.is_text() ? file.number<std::int64_t>() :
                                file.bytes<std::int32_t>();
      }

      void
      read_nodes(const bool are_parametric)
      {
        for (auto n = size_of_section("nodes"); n > 0; --n)
          {
            const std::int64_t tag = node_number();
            dealii::Point<3>   x;
            for (unsigned int d = 0; d < 3; ++d)
              x[d] = file.next<double>();
            if (tag < 0 || !std::isfinite(x[0]) || !std::isfinite(x[1]) ||
                !std::isfinite(x[2]))
              file.refuse(fmt::format("found the node {} at ({}, {}, {}); "
                                      "numbers of nodes are positive, and "
                                      "coordinates finite",
                                      tag,
                                      x[0],
                                      x[1],
                                      x[2]));
            if (!builder.add_node(tag, x))
              file.refuse(
                fmt::format("node {} is there already, at another place", tag));
            if (!are_parametric)
              continue;
            // Skips the entity that the node is on, and its parameters there.
            const int dimension = file.next<std::int32_t>();
            file.next<std::int32_t>();
            for (int d = 0; d < dimension && dimension < 3; ++d)
              file.next<double>();
          }
      }

      const GmshType &
      type_of(const int number) const
      {
        const auto found = gmsh_types().find(number);
        if (found == gmsh_types().end())
          file.refuse(
            fmt::format("found an element of gmsh's type {}; allowed "
                        "are 4, 11 and 29, tetrahedra, with 2, 9, 21, "
                        "1, 8, 26 and 15 for names",
                        number));
        return found->second;
      }

      void
      read_elements()
      {
        for (auto left = size_of_section("elements"); left > 0;)
          if (file.is_text())
            {
              file.number<std::int64_t>();
              const int number = file.number<int>();
              read_element(number, type_of(number), file.number<int>());
              --left;
            }
          else
            {
              const int   number = file.bytes<std::int32_t>();
              const auto &type   = type_of(number);
              const auto  n      = file.bytes<std::int32_t>();
              const auto  n_tags = file.bytes<std::int32_t>();
              if (n < 1 || n > left)
                file.refuse(fmt::format("found a block of {} elements where {} "
                                        "are left; is the file damaged?",
                                        n,
                                        left));
              for (int i = 0; i < n; ++i)
                {
                  file.bytes<std::int32_t>();
                  read_element(number, type, n_tags);
                }
              left -= n;
            }
      }

      // Reads an element. The tags are the physical group, the entity, and
      // partitions if there are any: their number, that of the element, and
      // negative those of which it is a ghost.
      void
      read_element(const int number, const GmshType &type, const int n_tags)
      {
        if (n_tags < 0 || n_tags > 100000)
          file.refuse(fmt::format("found {} tags of an element", n_tags));
        int group = 0, entity = 0;
        for (int i = 0; i < n_tags; ++i)
          {
            const int tag = file.next<std::int32_t>();
            if (i == 0)
              group = tag;
            else if (i == 1)
              entity = tag;
            else if (i == 3 && type.dimension == 3 && tag > 0)
              partitions.insert(tag);
            if (i >= 3)
              all_partitions.insert(tag < 0 ? -(tag + 0LL) : tag);
          }
        nodes.clear();
        for (unsigned int i = 0; i < type.n_nodes; ++i)
          {
            const std::int64_t node = node_number();
            if (node < 0)
              file.refuse(
                fmt::format("found the node {} of an element; numbers "
                            "of nodes are positive",
                            node));
            nodes.push_back(node);
          }
        // A negative group means that the element is turned over.
        if (group == INT_MIN)
          file.refuse(fmt::format("found the physical group {}", group));
        all.push_back({number,
                       n_tags > 0 ? std::abs(group) : -1,
                       entity,
                       all_nodes.size()});
        all_nodes.insert(all_nodes.end(), nodes.begin(), nodes.end());
      }

      // Adds the elements in the order of their entities, as gmsh does.
      void
      sort_by_entity()
      {
        std::stable_sort(all.begin(),
                         all.end(),
                         [](const Element &a, const Element &b) {
                           return a.entity < b.entity;
                         });
        for (const Element &element : all)
          {
            const std::size_t e =
              builder.add_element(element.type,
                                  {all_nodes.data() + element.first_node,
                                   gmsh_types().at(element.type).n_nodes});
            if (element.group > 0 || (zero_is_group && element.group == 0))
              builder.add_to_group(e, element.group);
          }
        all.clear();
        all_nodes.clear();
      }

      struct Element
      {
        int         type, group, entity;
        std::size_t first_node;
      };

      const bool                 zero_is_group;
      MshNumbers                 file;
      std::vector<Element>       all;
      std::vector<std::uint64_t> all_nodes, nodes;
      ModelBuilder               builder;
      // The partitions that cells belong to, and all that occur.
      std::set<int>          partitions;
      std::set<std::int64_t> all_partitions;
    };
  } // namespace



  GmshModel
  read_msh_2(const std::string &path,
             const bool         zero_is_group,
             const std::string &origin)
  {
    return Msh2Reader(path, zero_is_group, origin).model();
  }
} // namespace corotet
