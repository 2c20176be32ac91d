// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/gmsh_elements.h>
#include <corotet/mesh/gmsh_mesh.h>

#include <fmt/format.h>

#include <optional>
#include <set>
#include <unordered_map>

namespace corotet
{
  namespace
  {
    // The physical groups of one dimension: the id of each geometric entity
    // that belongs to some groups, and the names of these ids.
    struct PhysicalGroups
    {
      NamedSets                   named;
      std::map<int, unsigned int> of_entity;
    };



    // The groups of one dimension. Groups with the same name are united, with
    // the id of the first.
    std::vector<GmshModel::Group>
    groups_of(const GmshModel &model, const int dimension)
    {
      std::vector<GmshModel::Group>      groups;
      std::map<std::string, std::size_t> places;
      for (const GmshModel::Group &group : model.groups)
        if (group.dimension == dimension)
          {
            const auto [place, is_new] =
              group.name.empty() ? std::pair(places.end(), true) :
                                   places.emplace(group.name, groups.size());
            if (is_new)
              groups.push_back(group);
            else
              groups[place->second].entities.insert(
                groups[place->second].entities.end(),
                group.entities.begin(),
                group.entities.end());
          }
      return groups;
    }



    // The ids of entities: an entity of one group has the group's id; an entity
    // of several groups shares an id with the other entities of the same
    // groups.
    PhysicalGroups
    physical_groups(const GmshModel &model, const int dimension)
    {
      std::map<unsigned int, std::string>            names;
      std::map<int, std::set<unsigned int>>          groups_of_entity;
      std::map<std::set<unsigned int>, unsigned int> ids;
      for (const GmshModel::Group &group : groups_of(model, dimension))
        {
          names[group.id]                            = group.name;
          ids[{static_cast<unsigned int>(group.id)}] = group.id;
          for (const int entity : group.entities)
            groups_of_entity[entity].insert(group.id);
        }
      PhysicalGroups result;
      unsigned int   next = names.empty() ? 0 : names.rbegin()->first + 1;
      std::map<unsigned int, std::set<unsigned int>> meaning;
      for (const auto &[entity, groups] : groups_of_entity)
        {
          const auto [id, is_new] = ids.emplace(groups, next);
          if (is_new)
            ++next;
          result.of_entity[entity] = id->second;
          for (const unsigned int group : groups)
            meaning[group].insert(id->second);
        }
      for (const auto &[group, name] : names)
        if (const std::set<unsigned int> &of_group = meaning[group];
            of_group.size() > 1 ||
            (of_group.size() == 1 && *of_group.begin() != group))
          {
            const std::vector<unsigned int> all(of_group.begin(),
                                                of_group.end());
            result.named.sets[name.empty() ? std::to_string(group) : name] =
              all;
            result.named.parts[group] = all;
          }
        else
          result.named.names[group] = name;
      return result;
    }



    // The nodes that elements use, numbered in the order of their first use:
    // gmsh's tags may be sparse, and some nodes belong to no element.
    class UsedNodes
    {
    public:
      explicit UsedNodes(const GmshModel &model)
        : coordinates(model.coordinates)
      {
        for (std::size_t i = 0; i < model.node_tags.size(); ++i)
          positions.emplace(model.node_tags[i], i);
      }

      dealii::Point<3>
      position(const SerialMesh &mesh, const std::size_t tag) const
      {
        const auto found = positions.find(tag);
        if (found == positions.end())
          throw InputError("",
                           fmt::format("{}: an element has the node {}, which "
                                       "the file does not contain",
                                       mesh.origin,
                                       tag));
        const double *x = coordinates.data() + 3 * found->second;
        return {x[0], x[1], x[2]};
      }

      unsigned int
      vertex(SerialMesh &mesh, const std::size_t tag)
      {
        const auto [number, is_new] =
          numbers.emplace(tag, mesh.vertices.size());
        if (is_new)
          mesh.vertices.push_back(position(mesh, tag));
        return number->second;
      }

      // The vertex of a node, if the node is a vertex already.
      std::optional<unsigned int>
      known_vertex(const std::size_t tag) const
      {
        const auto found = numbers.find(tag);
        if (found == numbers.end())
          return {};
        return found->second;
      }

    private:
      const std::vector<double>                    &coordinates;
      std::unordered_map<std::size_t, std::size_t>  positions;
      std::unordered_map<std::size_t, unsigned int> numbers;
    };



    void
    read_cells(SerialMesh                      &mesh,
               const GmshModel                 &model,
               UsedNodes                       &nodes,
               const gmsh_elements::Tetrahedra &kind,
               const PhysicalGroups            &groups)
    {
      const std::size_t n          = kind.order.size();
      std::size_t       n_left_out = 0;
      const bool        has_groups =
        !groups.named.names.empty() || !groups.named.sets.empty();
      mesh.geometry_degree = kind.degree;
      for (const GmshModel::Elements &elements : model.volumes)
        {
          const std::vector<std::uint64_t> &tags = elements.nodes;
          const auto group = groups.of_entity.find(elements.entity);
          if (group == groups.of_entity.end() && has_groups)
            {
              n_left_out += tags.size() / n;
              continue;
            }
          const unsigned int region =
            group == groups.of_entity.end() ? 0 : group->second;
          for (std::size_t i = 0; i + n <= tags.size(); i += n)
            {
              mesh.cells.push_back({{{nodes.vertex(mesh, tags[i]),
                                      nodes.vertex(mesh, tags[i + 1]),
                                      nodes.vertex(mesh, tags[i + 2]),
                                      nodes.vertex(mesh, tags[i + 3])}},
                                    region});
              if (kind.degree == 1)
                continue;
              mesh.cells.back().curve = mesh.curved_nodes.size() / n;
              for (const unsigned int j : kind.order)
                mesh.curved_nodes.push_back(nodes.position(mesh, tags[i + j]));
            }
        }
      if (const std::string remark = remove_written_straight_maps(mesh);
          !remark.empty())
        mesh.remarks.push_back(remark);
      if (n_left_out > 0)
        mesh.remarks.push_back(
          fmt::format("{} tetrahedra belong to no physical volume, though "
                      "others do; they are left out",
                      n_left_out));
    }



    void
    read_faces(SerialMesh           &mesh,
               const GmshModel      &model,
               UsedNodes            &nodes,
               const PhysicalGroups &groups)
    {
      // The surfaces in the order of their entities.
      std::multimap<int, const GmshModel::Elements *> surfaces;
      for (const GmshModel::Elements &elements : model.surfaces)
        surfaces.emplace(elements.entity, &elements);
      for (const auto &[entity, elements] : surfaces)
        {
          const auto group = groups.of_entity.find(entity);
          if (group == groups.of_entity.end())
            continue;
          const std::vector<std::uint64_t> &tags = elements->nodes;
          const std::size_t                 n =
            gmsh_elements::triangle_nodes.at(elements->type);
          for (std::size_t i = 0; i + n <= tags.size(); i += n)
            mesh.faces.push_back({{{nodes.vertex(mesh, tags[i]),
                                    nodes.vertex(mesh, tags[i + 1]),
                                    nodes.vertex(mesh, tags[i + 2])}},
                                  group->second});
        }
    }



    // Calls @p add with the ends of each line of the physical curves, or each
    // physical point, and the group's id. A remark counts those with a node
    // that is not a vertex of a cell.
    template <typename Add>
    void
    read_parts(SerialMesh                             &mesh,
               const GmshModel                        &model,
               const std::vector<GmshModel::Elements> &all,
               const UsedNodes                        &nodes,
               const int                               dimension,
               const Add                              &add)
    {
      const gmsh_elements::NodeNumbers &n_nodes =
        dimension == 1 ? gmsh_elements::line_nodes : gmsh_elements::point_nodes;
      const std::size_t last = dimension == 1 ? 1 : 0;
      std::multimap<int, const GmshModel::Elements *> of_entity;
      for (const GmshModel::Elements &elements : all)
        of_entity.emplace(elements.entity, &elements);
      NamedSets &named = dimension == 1 ? mesh.edge_names : mesh.corner_names;
      for (const GmshModel::Group &group : groups_of(model, dimension))
        {
          named.names[group.id]  = group.name;
          std::size_t n_left_out = 0;
          for (const int entity :
               std::set<int>(group.entities.begin(), group.entities.end()))
            for (auto [part, end] = of_entity.equal_range(entity); part != end;
                 ++part)
              {
                const auto       &tags = part->second->nodes;
                const std::size_t n    = n_nodes.at(part->second->type);
                for (std::size_t i = 0; i + n <= tags.size(); i += n)
                  {
                    const auto a = nodes.known_vertex(tags[i]);
                    const auto b = nodes.known_vertex(tags[i + last]);
                    if (a && b)
                      add(*a, *b, group.id);
                    else
                      ++n_left_out;
                  }
              }
          if (n_left_out > 0)
            mesh.remarks.push_back(
              fmt::format("{} {} of '{}' are not in the cells; they are left "
                          "out",
                          n_left_out,
                          dimension == 1 ? "lines" : "points",
                          group.name.empty() ? std::to_string(group.id) :
                                               group.name));
        }
    }



    void
    read_edges_and_corners(SerialMesh      &mesh,
                           const GmshModel &model,
                           const UsedNodes &nodes)
    {
      read_parts(mesh,
                 model,
                 model.curves,
                 nodes,
                 1,
                 [&](const unsigned int a, const unsigned int b, const int id) {
                   mesh.edges.push_back(
                     {{{a, b}}, static_cast<unsigned int>(id)});
                 });
      read_parts(mesh,
                 model,
                 model.points,
                 nodes,
                 0,
                 [&](const unsigned int a, const unsigned int, const int id) {
                   mesh.corners.push_back({a, static_cast<unsigned int>(id)});
                 });
    }
  } // namespace



  SerialMesh
  mesh_of_model(const GmshModel   &model,
                const std::string &path,
                const bool         has_geometry)
  {
    const gmsh_elements::Tetrahedra kind =
      gmsh_elements::tetrahedra(model, path);
    const PhysicalGroups volumes  = physical_groups(model, 3);
    const PhysicalGroups surfaces = physical_groups(model, 2);

    if (model.only_partition > 0)
      throw InputError(
        "",
        fmt::format("{}: found the cells of partition {} only; allowed is a "
                    "file with those of all partitions, as gmsh writes without "
                    "the option -part_split",
                    path,
                    model.only_partition));
    SerialMesh mesh;
    mesh.origin     = path;
    mesh.regions    = volumes.named;
    mesh.boundaries = surfaces.named;
    if (!model.remark.empty())
      mesh.remarks.push_back(printable(model.remark, false));
    UsedNodes nodes(model);
    read_cells(mesh, model, nodes, kind, volumes);
    read_faces(mesh, model, nodes, surfaces);
    read_edges_and_corners(mesh, model, nodes);
    // Straight cells may have additional nodes in the file.
    if (mesh.geometry_degree > 1)
      return mesh;
    std::set<unsigned int> curved;
    for (const int entity : model.curved_surfaces)
      if (const auto group = surfaces.of_entity.find(entity);
          group == surfaces.of_entity.end())
        curved.insert(no_boundary);
      else
        curved.insert(group->second);
    remark_facets(mesh, has_geometry ? curved : faceted_boundaries(mesh));
    return mesh;
  }
} // namespace corotet
