// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/check_gmsh_file.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/gmsh_elements.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/gmsh_process.h>

#include <fmt/format.h>

#include <filesystem>
#include <unordered_map>

namespace corotet
{
  namespace
  {
    void
    check_file(const std::string &path)
    {
      std::error_code error;
      const bool      is_file = std::filesystem::is_regular_file(path, error);
      if (error && error != std::errc::no_such_file_or_directory)
        throw InputError("Mesh/gmsh/File",
                         shortened(path) + ": " + error.message());
      if (!is_file)
        throw InputError("Mesh/gmsh/File",
                         "there is no mesh file: found '" + shortened(path) +
                           "'");
      const std::string extension =
        std::filesystem::path(path).extension().string();
      if (extension == ".msh")
        check_msh(path);
      else if (extension == ".geo")
        check_geo(path);
      else
        throw InputError("Mesh/gmsh/File",
                         "the kind of mesh file is unknown: found '" +
                           shortened(path) + "'; allowed are .msh and .geo");
    }



    // Physical groups of one dimension: names by id, and the id of each
    // geometric entity that belongs to a group.
    struct PhysicalGroups
    {
      std::map<unsigned int, std::string> names;
      std::map<int, unsigned int>         of_entity;
    };



    PhysicalGroups
    physical_groups(const GmshModel   &model,
                    const std::string &path,
                    const int          dimension)
    {
      const std::string kind = dimension == 3 ? "volume" : "surface";
      PhysicalGroups    groups;
      for (const GmshModel::Group &group : model.groups)
        {
          if (group.dimension != dimension)
            continue;
          groups.names[group.id] = group.name;
          for (const int entity : group.entities)
            {
              const auto [place, is_new] =
                groups.of_entity.emplace(entity, group.id);
              if (!is_new)
                throw InputError(
                  "",
                  fmt::format("{}: {} {} belongs to two physical groups: found "
                              "'{}' (id {}) and '{}' (id {}); one is allowed "
                              "(a file of version 2.2 needs an elementary tag "
                              "of its own for each group)",
                              path,
                              kind,
                              entity,
                              groups.names[place->second],
                              place->second,
                              group.name,
                              group.id));
            }
        }
      return groups;
    }



    // The nodes that elements use, in the order in which they are asked for:
    // gmsh's tags may be sparse, and there may be nodes of no element.
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
      mesh.geometry_degree         = kind.degree;
      for (const GmshModel::Elements &elements : model.volumes)
        {
          const std::vector<std::uint64_t> &tags = elements.nodes;
          const auto group = groups.of_entity.find(elements.entity);
          if (group == groups.of_entity.end() && !groups.names.empty())
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
      remove_straight_maps(mesh);
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
      // Of the types that triangles of degree 1, 2, 3 have; corners come first.
      const std::map<int, unsigned int> n_nodes{{2, 3}, {9, 6}, {21, 10}};
      // In the order of the entities.
      std::multimap<int, const GmshModel::Elements *> surfaces;
      for (const GmshModel::Elements &elements : model.surfaces)
        surfaces.emplace(elements.entity, &elements);
      for (const auto &[entity, elements] : surfaces)
        {
          const auto group = groups.of_entity.find(entity);
          if (group == groups.of_entity.end())
            continue;
          const std::vector<std::uint64_t> &tags = elements->nodes;
          const std::size_t                 n    = n_nodes.at(elements->type);
          for (std::size_t i = 0; i + n <= tags.size(); i += n)
            mesh.faces.push_back({{{nodes.vertex(mesh, tags[i]),
                                    nodes.vertex(mesh, tags[i + 1]),
                                    nodes.vertex(mesh, tags[i + 2])}},
                                  group->second});
        }
    }
  } // namespace



  SerialMesh
  mesh_of_model(const GmshModel   &model,
                const std::string &path,
                const bool         has_geometry)
  {
    const gmsh_elements::Tetrahedra kind =
      gmsh_elements::tetrahedra(model, path);
    const PhysicalGroups volumes  = physical_groups(model, path, 3);
    const PhysicalGroups surfaces = physical_groups(model, path, 2);

    SerialMesh mesh;
    mesh.origin         = path;
    mesh.region_names   = volumes.names;
    mesh.boundary_names = surfaces.names;
    UsedNodes nodes(model);
    read_cells(mesh, model, nodes, kind, volumes);
    read_faces(mesh, model, nodes, surfaces);
    if (kind.degree > 1)
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



  void
  GmshMesh::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("File",
                      file,
                      "A gmsh mesh (.msh, version 2.2 or 4.1, ASCII or binary) "
                      "or geometry (.geo), relative to the folder of this "
                      "file.",
                      dealii::Patterns::FileName());
    prm.add_parameter("Element size",
                      element_size,
                      "Target length of edges for a .geo [m, before scaling]; "
                      "0 leaves it to the file. A .msh needs 0.",
                      dealii::Patterns::Double(0));
    prm.add_parameter(
      "Geometry degree",
      geometry_degree,
      "Degree of the cells' maps for a .geo [-]: 1 for straight "
      "cells, 2 or 3 for curved ones along curved surfaces. A "
      ".msh has that of its cells, and needs 1 here. Elements "
      "of a lower degree interpolate the geometry.",
      dealii::Patterns::Integer(1, 3));
    prm.add_parameter("Time limit",
                      time_limit,
                      "What gmsh may take to read or to mesh the file [s].",
                      dealii::Patterns::Double(1, 1e9));
  }



  SerialMesh
  GmshMesh::create(const std::string &folder,
                   const unsigned int n_refinements) const
  {
    if (file.empty())
      throw InputError("Mesh/gmsh/File",
                       "no mesh file: found an empty name; give the name of a "
                       ".msh or .geo file");
    const std::string path =
      (std::filesystem::path(folder) / file).lexically_normal().string();
    check_file(path);
    const bool is_geometry = std::filesystem::path(path).extension() == ".geo";
    if (element_size > 0 && !is_geometry)
      throw InputError("Mesh/gmsh/Element size",
                       fmt::format("only a .geo can be given an element size: "
                                   "found {} for '{}'; 0 is allowed",
                                   element_size,
                                   path));
    if (geometry_degree > 1 && !is_geometry)
      throw InputError("Mesh/gmsh/Geometry degree",
                       fmt::format("a .msh has the degree of its cells: found "
                                   "{} for '{}'; 1 is allowed",
                                   geometry_degree,
                                   path));

    const GmshModel model =
      run_gmsh({path,
                is_geometry,
                element_size,
                geometry_degree,
                is_geometry ? n_refinements : 0,
                largest_number_of_cells(is_geometry ? n_refinements : 0),
                time_limit});
    if (model.is_too_large)
      {
        std::size_t n_cells = 0;
        for (const GmshModel::ElementType &type : model.volume_types)
          n_cells += type.n_elements;
        check_number_of_cells(n_cells, n_refinements);
      }
    SerialMesh mesh = mesh_of_model(model, path, is_geometry);
    if (is_geometry)
      mesh.n_refinements = n_refinements;
    return mesh;
  }
} // namespace corotet
