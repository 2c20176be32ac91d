// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/msh_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <set>

#include "msh_nodes.h"

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using Text = std::back_insert_iterator<std::string>;

    // gmsh's numbers of types of degree 1, 2, 3.
    constexpr int line_types[]{1, 8, 26}, triangle_types[]{2, 9, 21},
      tetrahedron_types[]{4, 11, 29};

    struct ElementType
    {
      int                         dimension;
      int                         type;
      const std::vector<MshNode> &nodes;
    };

    // The box around the parts with one id, and the tag of the entity that they
    // form.
    struct Extent
    {
      Point<3> low, high;
      bool     is_empty = true;
      int      tag      = 0;

      void
      add(const Point<3> &x)
      {
        for (unsigned int d = 0; d < 3; ++d)
          {
            low[d]  = is_empty ? x[d] : std::min(low[d], x[d]);
            high[d] = is_empty ? x[d] : std::max(high[d], x[d]);
          }
        is_empty = false;
      }
    };

    // Entities of gmsh of one dimension, by the ids of regions, boundaries,
    // edges or corners, and their physical groups.
    struct Entities
    {
      std::map<unsigned int, Extent>           extents;
      std::map<unsigned int, std::vector<int>> groups_of_id;
      std::map<int, std::string>               names;

      // The tag of an id. gmsh's tags must be positive, but ids may be any
      // number, so tags follow the order of the ids.
      int
      tag(const unsigned int id) const
      {
        return extents.at(id).tag;
      }

      void
      number()
      {
        int last = 0;
        for (auto &[id, extent] : extents)
          extent.tag = ++last;
      }

      // Whether a name means exactly these ids.
      static bool
      is_set(const NamedSets &named, const std::vector<unsigned int> &ids)
      {
        return std::any_of(named.sets.begin(),
                           named.sets.end(),
                           [&](const auto &set) { return set.second == ids; });
      }

      // The next number that is not an id.
      int
      free_group(int &last) const
      {
        while (extents.contains(++last))
          ;
        return last;
      }

      // Adds the physical groups. Groups have the numbers of ids, so that ids
      // without a name keep their numbers; gmsh has no group 0, which gets its
      // number as a name. Names of several ids become further groups.
      void
      add_groups(const NamedSets &named)
      {
        constexpr unsigned int largest = std::numeric_limits<int>::max();
        // Further groups are numbered behind all ids, if there is room for
        // them.
        int last = 0;
        if (!extents.empty() &&
            extents.rbegin()->first < largest - extents.size() - 1 &&
            named.sets.size() <
              largest - extents.size() - 1 - extents.rbegin()->first)
          last = static_cast<int>(extents.rbegin()->first);
        const auto add =
          [&](const std::string &name, const int group, const auto &ids) {
            // Files cannot contain quotation marks in names.
            names[group] = name;
            std::replace(names[group].begin(), names[group].end(), '"', '\'');
            for (const unsigned int id : ids)
              groups_of_id[id].push_back(group);
          };
        // A body in one piece without names needs no group.
        const bool has_names =
          extents.size() > 1 || !named.sets.empty() ||
          std::any_of(named.names.begin(),
                      named.names.end(),
                      [](const auto &entry) { return !entry.second.empty(); });
        if (!has_names && extents.begin() != extents.end() &&
            extents.begin()->first == 0)
          return;
        std::set<unsigned int> in_sets;
        for (const auto &[name, ids] : named.sets)
          {
            add(name, free_group(last), ids);
            in_sets.insert(ids.begin(), ids.end());
          }
        for (const auto &[id, extent] : extents)
          {
            const auto        found = named.names.find(id);
            const std::string name =
              found == named.names.end() ? "" : found->second;
            const auto                      parts = named.parts.find(id);
            const std::vector<unsigned int> of_number =
              parts == named.parts.end() ? std::vector{id} : parts->second;
            const bool has_number =
              of_number.size() > 1 && !is_set(named, of_number);
            if (name.empty() && in_sets.contains(id) && !has_number)
              continue;
            const bool is_group = id > 0 && id <= largest;
            add(is_group || !name.empty() ? name : std::to_string(id),
                is_group ? static_cast<int>(id) : free_group(last),
                of_number);
          }
      }
    };

    // The entities of a mesh, by their dimension.
    using AllEntities = std::array<Entities, 4>;

    AllEntities
    entities_of(const SerialMesh &mesh)
    {
      AllEntities all;
      const auto &x = mesh.vertices;
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          all[3].extents[cell.region].add(x[v]);
      for (const SerialMesh::Face &face : mesh.faces)
        for (const unsigned int v : face.vertices)
          all[2].extents[face.boundary].add(x[v]);
      for (const SerialMesh::Edge &edge : mesh.edges)
        for (const unsigned int v : edge.vertices)
          all[1].extents[edge.id].add(x[v]);
      for (const SerialMesh::Corner &corner : mesh.corners)
        all[0].extents[corner.id].add(x[corner.vertex]);
      for (Entities &entities : all)
        entities.number();
      all[3].add_groups(mesh.regions);
      all[2].add_groups(mesh.boundaries);
      all[1].add_groups(mesh.edge_names);
      all[0].add_groups(mesh.corner_names);
      return all;
    }

    void
    write_names(Text text, const AllEntities &all)
    {
      std::size_t n = 0;
      std::string lines;
      for (unsigned int dimension = 0; dimension < 4; ++dimension)
        for (const auto &[group, name] : all[dimension].names)
          if (!name.empty())
            {
              ++n;
              lines += fmt::format("{} {} \"{}\"\n", dimension, group, name);
            }
      if (n > 0)
        fmt::format_to(text,
                       "$PhysicalNames\n{}\n{}$EndPhysicalNames\n",
                       n,
                       lines);
    }

    void
    write_groups(Text text, const Entities &entities, const unsigned int id)
    {
      const auto groups = entities.groups_of_id.find(id);
      if (groups == entities.groups_of_id.end())
        fmt::format_to(text, " 0");
      else
        fmt::format_to(text,
                       " {} {}",
                       groups->second.size(),
                       fmt::join(groups->second, " "));
    }

    // An entity of dimension 0 is a single point, so each corner is an entity
    // of its own.
    void
    write_entities(Text text, const AllEntities &all, const SerialMesh &mesh)
    {
      fmt::format_to(text,
                     "$Entities\n{} {} {} {}\n",
                     mesh.corners.size(),
                     all[1].extents.size(),
                     all[2].extents.size(),
                     all[3].extents.size());
      int tag = 0;
      for (const auto &[vertex, id] : mesh.corners)
        {
          const Point<3> &x = mesh.vertices[vertex];
          fmt::format_to(text, "{} {} {} {}", ++tag, x[0], x[1], x[2]);
          write_groups(text, all[0], id);
          fmt::format_to(text, "\n");
        }
      for (unsigned int dimension = 1; dimension < 4; ++dimension)
        for (const auto &[id, extent] : all[dimension].extents)
          {
            fmt::format_to(text, "{}", all[dimension].tag(id));
            for (const Point<3> &x : {extent.low, extent.high})
              fmt::format_to(text, " {} {} {}", x[0], x[1], x[2]);
            write_groups(text, all[dimension], id);
            // The bounding entities are not written.
            fmt::format_to(text, " 0\n");
          }
      fmt::format_to(text, "$EndEntities\n");
    }

    void
    write_nodes(Text text, const MshNodes &nodes, const int entity)
    {
      const std::size_t n = nodes.all().size();
      fmt::format_to(text, "$Nodes\n1 {} 1 {}\n3 {} 0 {}\n", n, n, entity, n);
      for (std::size_t i = 1; i <= n; ++i)
        fmt::format_to(text, "{}\n", i);
      // Coordinates have the fewest digits that give the same number.
      for (const Point<3> &x : nodes.all())
        fmt::format_to(text, "{} {} {}\n", x[0], x[1], x[2]);
      fmt::format_to(text, "$EndNodes\n");
    }

    // Writes elements, one entity after another. @p id_of gives the id of a
    // cell or a face.
    template <typename Elements, typename Id>
    void
    write_blocks(Text               text,
                 const Elements    &all,
                 const Id          &id_of,
                 const ElementType &type,
                 const Entities    &entities,
                 const MshNodes    &nodes,
                 std::size_t       &tag)
    {
      std::map<unsigned int, std::vector<std::size_t>> by_id;
      for (std::size_t i = 0; i < all.size(); ++i)
        by_id[id_of(all[i])].push_back(i);
      for (const auto &[id, members] : by_id)
        {
          fmt::format_to(text,
                         "{} {} {} {}\n",
                         type.dimension,
                         entities.tag(id),
                         type.type,
                         members.size());
          for (const std::size_t i : members)
            {
              fmt::format_to(text, "{}", ++tag);
              for (const MshNode &node : type.nodes)
                fmt::format_to(text, " {}", nodes.tag(all[i].vertices, node));
              fmt::format_to(text, "\n");
            }
        }
    }
  } // namespace



  std::string
  msh_text(const SerialMesh &mesh)
  {
    const unsigned int q = mesh.geometry_degree - 1;
    const MshNodes     nodes(mesh);
    const AllEntities  all = entities_of(mesh);

    std::string result = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    Text        text(result);
    write_names(text, all);
    write_entities(text, all, mesh);
    // All nodes are listed as those of the first volume.
    write_nodes(text, nodes, 1);
    const std::size_t n = mesh.corners.size() + mesh.edges.size() +
                          mesh.faces.size() + mesh.cells.size();
    fmt::format_to(text,
                   "$Elements\n{} {} 1 {}\n",
                   mesh.corners.size() + all[1].extents.size() +
                     all[2].extents.size() + all[3].extents.size(),
                   n,
                   n);
    std::size_t tag = 0;
    for (const SerialMesh::Corner &corner : mesh.corners)
      {
        ++tag;
        fmt::format_to(text, "0 {} 15 1\n{} {}\n", tag, tag, corner.vertex + 1);
      }
    write_blocks(
      text,
      mesh.edges,
      [](const SerialMesh::Edge &edge) { return edge.id; },
      {1, line_types[q], line_nodes[q]},
      all[1],
      nodes,
      tag);
    write_blocks(
      text,
      mesh.faces,
      [](const SerialMesh::Face &face) { return face.boundary; },
      {2, triangle_types[q], triangle_nodes[q]},
      all[2],
      nodes,
      tag);
    write_blocks(
      text,
      mesh.cells,
      [](const SerialMesh::Cell &cell) { return cell.region; },
      {3, tetrahedron_types[q], tetrahedron_nodes[q]},
      all[3],
      nodes,
      tag);
    fmt::format_to(text, "$EndElements\n");
    return result;
  }



  void
  write_msh_file(const std::string &path, const SerialMesh &mesh)
  {
    write_whole_file(path, msh_text(mesh), "the mesh");
  }
} // namespace corotet
