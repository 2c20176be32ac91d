// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/gmsh_elements.h>
#include <corotet/mesh/gmsh_mesh.h>

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <unordered_map>

namespace corotet
{
  namespace
  {
    // The library's state, which is global: from here to the end of the scope.
    class Session
    {
    public:
      Session()
      {
        // Neither the user's configuration nor a handler of Ctrl-C.
        gmsh::initialize(0, nullptr, false, false);
        gmsh::option::setNumber("General.Terminal", 0);
      }

      ~Session()
      {
        try
          {
            gmsh::finalize();
          }
        catch (...)
          {
            // Nothing is left to be saved.
          }
      }

      Session(const Session &) = delete;
      Session &
      operator=(const Session &) = delete;
    };



    // An error of gmsh, "'PATH', line N: TEXT" or any other text, as
    // "PATH:N: TEXT" or "PATH: TEXT".
    std::string
    message_of_gmsh(const std::string &path, std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      const std::string start = "'" + path + "', line ";
      if (text.compare(0, start.size(), start) != 0)
        return path + ": gmsh: " + text;
      const std::size_t colon = text.find(':', start.size());
      return path + ":" + text.substr(start.size(), colon - start.size()) +
             ": gmsh" + text.substr(std::min(colon, text.size()));
    }



    // gmsh takes whatever does not look like a mesh for a script.
    void
    check_file(const std::string &path)
    {
      if (!std::filesystem::is_regular_file(path))
        throw InputError("Mesh/gmsh/File",
                         "there is no mesh file: found '" + path + "'");
      const std::string extension =
        std::filesystem::path(path).extension().string();
      if (extension != ".msh" && extension != ".geo")
        throw InputError("Mesh/gmsh/File",
                         "the kind of mesh file is unknown: found '" + path +
                           "'; allowed are .msh and .geo");
      std::ifstream stream(path);
      if (!stream)
        throw MachineError(path + ": cannot be read (permission?)");
      if (extension == ".msh" && stream.get() != '$')
        throw InputError("",
                         path + ": is no gmsh mesh: it must start with "
                                "'$MeshFormat'");
    }



    // The cells of a geometry, of degree 1.
    void
    generate(const std::string &path, const double element_size)
    {
      gmsh::open(path);
      // After the file, which may set them too.
      gmsh::option::setNumber("Mesh.ElementOrder", 1);
      if (element_size > 0)
        {
          gmsh::option::setNumber("Mesh.MeshSizeMin", element_size);
          gmsh::option::setNumber("Mesh.MeshSizeMax", element_size);
        }
      gmsh::model::mesh::generate(3);
    }



    // Refined @p n_refinements times, with vertices on the geometry, and then
    // of degree @p degree.
    void
    refine(const std::string &path,
           const unsigned int n_refinements,
           const unsigned int degree)
    {
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(gmsh_elements::tetrahedra(path).type,
                                           elements,
                                           nodes);
      check_number_of_cells(elements.size(), n_refinements);
      for (unsigned int i = 0; i < n_refinements; ++i)
        gmsh::model::mesh::refine();
      if (degree > 1)
        gmsh::model::mesh::setOrder(degree);
    }



    // Physical groups of one dimension: names by id, and the id of each
    // geometric entity that belongs to a group.
    struct PhysicalGroups
    {
      std::map<unsigned int, std::string> names;
      std::map<int, unsigned int>         of_entity;
    };



    PhysicalGroups
    physical_groups(const std::string &path, const int dimension)
    {
      const std::string kind = dimension == 3 ? "volume" : "surface";
      PhysicalGroups    groups;
      gmsh::vectorpair  tags;
      gmsh::model::getPhysicalGroups(tags, dimension);
      for (const auto &[dim, id] : tags)
        {
          std::string name;
          gmsh::model::getPhysicalName(dim, id, name);
          groups.names[id] = name;

          std::vector<int> entities;
          gmsh::model::getEntitiesForPhysicalGroup(dim, id, entities);
          for (const int entity : entities)
            {
              const auto [place, is_new] = groups.of_entity.emplace(entity, id);
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
                              name,
                              id));
            }
        }
      return groups;
    }



    // The nodes that elements use, in the order in which they are asked for:
    // gmsh's tags may be sparse, and there may be nodes of no element.
    class UsedNodes
    {
    public:
      UsedNodes()
      {
        std::vector<std::size_t> tags;
        std::vector<double>      parameters;
        gmsh::model::mesh::getNodes(tags, coordinates, parameters);
        for (std::size_t i = 0; i < tags.size(); ++i)
          positions.emplace(tags[i], i);
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
      std::vector<double>                           coordinates;
      std::unordered_map<std::size_t, std::size_t>  positions;
      std::unordered_map<std::size_t, unsigned int> numbers;
    };



    void
    read_cells(SerialMesh                      &mesh,
               UsedNodes                       &nodes,
               const gmsh_elements::Tetrahedra &kind,
               const PhysicalGroups            &groups)
    {
      const std::size_t n          = kind.order.size();
      std::size_t       n_left_out = 0;
      gmsh::vectorpair  entities;
      gmsh::model::getEntities(entities, 3);
      mesh.geometry_degree = kind.degree;
      for (const auto &[dimension, entity] : entities)
        {
          std::vector<std::size_t> elements, tags;
          gmsh::model::mesh::getElementsByType(kind.type,
                                               elements,
                                               tags,
                                               entity);
          const auto group = groups.of_entity.find(entity);
          if (group == groups.of_entity.end() && !groups.names.empty())
            {
              n_left_out += elements.size();
              continue;
            }
          const unsigned int region =
            group == groups.of_entity.end() ? 0 : group->second;
          for (std::size_t i = 0; i < tags.size(); i += n)
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
    read_faces(SerialMesh &mesh, UsedNodes &nodes, const PhysicalGroups &groups)
    {
      for (const auto &[entity, boundary] : groups.of_entity)
        {
          const std::vector<std::size_t> corners =
            gmsh_elements::triangles(entity);
          for (std::size_t i = 0; i < corners.size(); i += 3)
            mesh.faces.push_back({{{nodes.vertex(mesh, corners[i]),
                                    nodes.vertex(mesh, corners[i + 1]),
                                    nodes.vertex(mesh, corners[i + 2])}},
                                  boundary});
        }
    }



    SerialMesh
    read(const std::string &path, const bool has_geometry)
    {
      const gmsh_elements::Tetrahedra kind    = gmsh_elements::tetrahedra(path);
      const PhysicalGroups            volumes = physical_groups(path, 3);
      const PhysicalGroups            surfaces = physical_groups(path, 2);

      SerialMesh mesh;
      mesh.origin         = path;
      mesh.region_names   = volumes.names;
      mesh.boundary_names = surfaces.names;
      UsedNodes nodes;
      read_cells(mesh, nodes, kind, volumes);
      read_faces(mesh, nodes, surfaces);
      if (kind.degree > 1)
        return mesh;
      std::set<unsigned int> curved;
      for (const int entity : gmsh_elements::curved_surfaces())
        if (const auto group = surfaces.of_entity.find(entity);
            group == surfaces.of_entity.end())
          curved.insert(no_boundary);
        else
          curved.insert(group->second);
      remark_facets(mesh, has_geometry ? curved : faceted_boundaries(mesh));
      return mesh;
    }
  } // namespace



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

    try
      {
        const Session session;
        if (!is_geometry)
          {
            gmsh::open(path);
            return read(path, false);
          }
        generate(path, element_size);
        refine(path, n_refinements, geometry_degree);
        SerialMesh mesh    = read(path, true);
        mesh.n_refinements = n_refinements;
        return mesh;
      }
    catch (const Error &)
      {
        throw;
      }
    catch (const std::exception &error)
      {
        throw InputError("", message_of_gmsh(path, error.what()));
      }
  }
} // namespace corotet
