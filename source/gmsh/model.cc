// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "model.h"

#include <gmsh.h>

#include <cmath>
#include <set>
#include <stdexcept>

#include "med.h"
#include "shapes.h"
#include "surfaces.h"

namespace corotet::gmsh_program
{
  namespace
  {
    // gmsh's types of tetrahedra with 4, 10 and 20 nodes.
    constexpr int tetrahedra[] = {4, 11, 29};



    std::vector<GmshModel::Group>
    groups(const int dimension)
    {
      std::vector<GmshModel::Group> result;
      gmsh::vectorpair              tags;
      gmsh::model::getPhysicalGroups(tags, dimension);
      for (const auto &[dim, id] : tags)
        {
          GmshModel::Group &group = result.emplace_back();
          group.dimension         = dim;
          group.id                = id;
          gmsh::model::getPhysicalName(dim, id, group.name);
          gmsh::model::getEntitiesForPhysicalGroup(dim, id, group.entities);
        }
      return result;
    }



    // One group for each entity, without a name, with the number of the entity.
    std::vector<GmshModel::Group>
    entities_as_groups(const int dimension)
    {
      std::vector<GmshModel::Group> result;
      gmsh::vectorpair              entities;
      gmsh::model::getEntities(entities, dimension);
      for (const auto &[dim, tag] : entities)
        result.push_back({dim, tag, "", {tag}});
      return result;
    }



    std::vector<GmshModel::ElementType>
    volume_types()
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 3);
      std::vector<GmshModel::ElementType> result;
      for (std::size_t i = 0; i < types.size(); ++i)
        {
          GmshModel::ElementType &type = result.emplace_back();
          type.type                    = types[i];
          type.n_elements              = elements[i].size();
          int dimension = 0, order = 0, n_nodes = 0, n_primary_nodes = 0;
          gmsh::model::mesh::getElementProperties(types[i],
                                                  type.name,
                                                  dimension,
                                                  order,
                                                  n_nodes,
                                                  type.nodes,
                                                  n_primary_nodes);
        }
      return result;
    }



    // The entities of a dimension, without the ghost entities of partitions,
    // which repeat cells of other entities.
    gmsh::vectorpair
    entities_without_ghosts(const int dimension)
    {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      std::erase_if(entities, [](const auto &entity) {
        std::string type;
        gmsh::model::getType(entity.first, entity.second, type);
        return type.starts_with("Ghost");
      });
      return entities;
    }



    // The elements of these types in each entity, one list per entity and type.
    template <typename Types>
    std::vector<GmshModel::Elements>
    elements(const int dimension, const Types &types)
    {
      std::vector<GmshModel::Elements> result;
      for (const auto &[dim, entity] : entities_without_ghosts(dimension))
        for (const int type : types)
          {
            std::vector<std::size_t> tags, nodes;
            gmsh::model::mesh::getElementsByType(type, tags, nodes, entity);
            if (!nodes.empty())
              result.push_back({entity, type, {nodes.begin(), nodes.end()}});
          }
      return result;
    }



    // The elements of entities that belong to a group.
    std::vector<GmshModel::Elements>
    elements_of_groups(const std::vector<GmshModel::Group> &groups,
                       const int                            dimension,
                       const std::vector<int>              &types)
    {
      std::set<int> entities;
      for (const GmshModel::Group &group : groups)
        if (group.dimension == dimension)
          entities.insert(group.entities.begin(), group.entities.end());
      std::vector<GmshModel::Elements> result;
      if (!entities.empty())
        for (GmshModel::Elements &found : elements(dimension, types))
          if (entities.contains(found.entity))
            result.push_back(std::move(found));
      return result;
    }



    // The only partition that has these cells, if there are others; else 0.
    int
    only_partition(const std::vector<GmshModel::Elements> &volumes)
    {
      std::set<int> with_cells;
      for (const GmshModel::Elements &elements : volumes)
        {
          std::vector<int> partitions;
          gmsh::model::getPartitions(3, elements.entity, partitions);
          with_cells.insert(partitions.begin(), partitions.end());
        }
      return gmsh::model::getNumberOfPartitions() > 1 &&
                 with_cells.size() == 1 ?
               *with_cells.begin() :
               0;
    }



    std::vector<int>
    curved_surfaces()
    {
      std::vector<int> result;
      gmsh::vectorpair surfaces;
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &[dimension, entity] : surfaces)
        {
          std::string type;
          gmsh::model::getType(dimension, entity, type);
          std::vector<int> volumes, curves;
          gmsh::model::getAdjacencies(dimension, entity, volumes, curves);
          if (type == "Plane" || type == "Discrete surface" || volumes.empty())
            continue;
          std::vector<std::size_t> tags;
          std::vector<double>      coordinates, parameters, normals;
          gmsh::model::mesh::getNodes(
            tags, coordinates, parameters, dimension, entity, true);
          gmsh::model::getNormal(entity, parameters, normals);
          for (std::size_t i = 3; i < normals.size(); i += 3)
            if (std::hypot(normals[i] - normals[0],
                           normals[i + 1] - normals[1],
                           normals[i + 2] - normals[2]) > 1e-3)
              {
                result.push_back(entity);
                break;
              }
        }
      return result;
    }



    // Sets degree 1 and the size of cells; 0 leaves the size as it is.
    void
    set_size(const double element_size)
    {
      gmsh::option::setNumber("Mesh.ElementOrder", 1);
      if (element_size > 0)
        {
          gmsh::option::setNumber("Mesh.MeshSizeMin", element_size);
          gmsh::option::setNumber("Mesh.MeshSizeMax", element_size);
        }
    }



    // Makes cells of degree 1 for a geometry.
    void
    generate(const double element_size)
    {
      set_size(element_size);
      gmsh::model::mesh::generate(3);
    }



    // Makes cells of the present sizes; returns the first error, if there is
    // one. If gmsh threw an exception, it could not make another mesh
    // afterwards.
    std::string
    try_to_generate()
    {
      gmsh::option::setNumber("General.AbortOnError", 0);
      gmsh::logger::start();
      gmsh::model::mesh::generate(3);
      std::vector<std::string> lines;
      gmsh::logger::get(lines);
      gmsh::logger::stop();
      gmsh::option::setNumber("General.AbortOnError", 2);
      for (const std::string &line : lines)
        if (line.starts_with("Error: "))
          return line.substr(7);
      return "";
    }



    // Makes cells for shapes of CAD programs. If the requested edges are too
    // long for a bent surface, triangles cross each other: then edges are
    // shortened there, and then everywhere. Returns a remark if the sizes are
    // not the requested ones.
    std::string
    generate_shapes(const double element_size)
    {
      set_size(element_size);
      const std::string error = try_to_generate();
      if (error.empty())
        return "";
      double longest = 0, shortest = 0;
      gmsh::option::getNumber("Mesh.MeshSizeMax", longest);
      gmsh::option::getNumber("Mesh.MeshSizeMin", shortest);
      // Without a requested size, edges are shorter where the surface is bent
      // anyway.
      const bool is_uniform = element_size > 0;
      if (is_uniform)
        shortest = longest / 10;
      for (const double factor : {1., 0.5})
        if (is_uniform || factor < 1)
          {
            gmsh::model::mesh::clear();
            gmsh::option::setNumber("Mesh.MeshSizeMax", factor * longest);
            gmsh::option::setNumber("Mesh.MeshSizeMin", factor * shortest);
            if (try_to_generate().empty())
              return std::string("with edges of the length that is ") +
                     (is_uniform ? "asked for" : "usual") +
                     " gmsh makes no mesh (" + error + "): they are " +
                     (factor < 1 ? "half as long" : "") +
                     (factor < 1 && is_uniform ? ", and " : "") +
                     (is_uniform ?
                        "down to a tenth as long where the surface is bent" :
                        "");
          }
      throw std::runtime_error(error);
    }



    void
    read_and_generate(const GmshRequest &request, GmshModel &model)
    {
      if (request.format == "surface")
        try
          {
            read_surface(request);
            generate(request.element_size);
          }
        catch (const std::runtime_error &error)
          {
            explain_surface(request, error);
          }
      else
        {
          if (request.format != "geo" && request.is_geometry)
            {
              model.groups             = read_shapes(request, model.remark);
              const std::string remark = generate_shapes(request.element_size);
              if (!remark.empty())
                model.remark += (model.remark.empty() ? "" : "; ") + remark;
              return;
            }
          gmsh::open(request.path);
          // The size is set after the file was read, as the file may set it,
          // too.
          if (request.is_geometry)
            generate(request.element_size);
        }
    }



    std::size_t
    n_cells()
    {
      std::vector<int>                      types;
      std::vector<std::vector<std::size_t>> elements, nodes;
      gmsh::model::mesh::getElements(types, elements, nodes, 3);
      std::size_t result = 0;
      for (const auto &of_type : elements)
        result += of_type.size();
      return result;
    }
  } // namespace



  GmshModel
  make_model(const GmshRequest &request)
  {
    if (request.format == "med")
      return read_med(request.path);
    GmshModel model;
    read_and_generate(request, model);
    if (request.is_geometry)
      {
        model.is_too_large = n_cells() > request.max_n_cells;
        if (!model.is_too_large)
          {
            // gmsh puts new vertices on the geometry.
            for (unsigned int i = 0; i < request.n_refinements; ++i)
              gmsh::model::mesh::refine();
            if (request.degree > 1)
              gmsh::model::mesh::setOrder(request.degree);
          }
      }
    model.volume_types = volume_types();
    if (model.is_too_large)
      return model;

    // The groups of shapes and of surfaces are set elsewhere.
    if (!request.is_geometry || request.format == "geo")
      for (const int dimension : {3, 2, 1, 0})
        {
          auto known = groups(dimension);
          // Other programs number properties and references, which become
          // gmsh's entities.
          if (known.empty() && dimension >= 2 && request.format != "msh" &&
              request.format != "geo")
            known = entities_as_groups(dimension);
          for (const GmshModel::Group &group : known)
            model.groups.push_back(group);
        }
    model.volumes        = elements(3, tetrahedra);
    model.only_partition = only_partition(model.volumes);
    // gmsh's types of triangles with 3, 6 and 10 nodes.
    model.surfaces        = elements(2, std::vector<int>{2, 9, 21});
    model.curved_surfaces = curved_surfaces();
    // gmsh's types of lines with 2, 3 and 4 nodes, and of points.
    model.curves = elements_of_groups(model.groups, 1, {1, 8, 26});
    model.points = elements_of_groups(model.groups, 0, {15});
    std::vector<std::size_t> tags;
    std::vector<double>      parameters;
    gmsh::model::mesh::getNodes(tags, model.coordinates, parameters);
    model.node_tags.assign(tags.begin(), tags.end());
    if (request.format == "geo")
      {
        // gmsh applies this factor when it writes a file.
        double factor = 1;
        gmsh::option::getNumber("Mesh.ScalingFactor", factor);
        for (double &x : model.coordinates)
          x *= factor;
      }
    return model;
  }
} // namespace corotet::gmsh_program
