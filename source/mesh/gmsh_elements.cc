// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/gmsh_elements.h>

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace corotet::gmsh_elements
{
  namespace
  {
    struct Properties
    {
      std::string name;
      int         dimension;
      int         order;
      int         n_nodes;
      /// One point after another.
      std::vector<double> coordinates;
      int                 n_primary_nodes;
    };



    Properties
    properties(const int type)
    {
      Properties result;
      gmsh::model::mesh::getElementProperties(type,
                                              result.name,
                                              result.dimension,
                                              result.order,
                                              result.n_nodes,
                                              result.coordinates,
                                              result.n_primary_nodes);
      return result;
    }



    // gmsh's reference tetrahedron is deal.II's.
    std::vector<unsigned int>
    node_order(const int type, const unsigned int degree)
    {
      const std::vector<double> theirs = properties(type).coordinates;
      std::vector<unsigned int> order;
      for (const dealii::Point<3> &ours : map_points(degree))
        for (unsigned int j = 0; j < theirs.size() / 3; ++j)
          if (ours.distance(
                {theirs[3 * j], theirs[3 * j + 1], theirs[3 * j + 2]}) < 1e-6)
            order.push_back(j);
      AssertDimension(order.size(), theirs.size() / 3);
      return order;
    }
  } // namespace



  Tetrahedra
  tetrahedra(const std::string &path)
  {
    const std::map<int, unsigned int>     degrees{{4, 1}, {11, 2}, {29, 3}};
    std::vector<int>                      types;
    std::vector<std::vector<std::size_t>> elements, nodes;
    gmsh::model::mesh::getElements(types, elements, nodes, 3);

    std::vector<std::string> others, kinds;
    Tetrahedra               result{};
    for (unsigned int i = 0; i < types.size(); ++i)
      if (const auto found = degrees.find(types[i]); found != degrees.end())
        {
          result = {found->first, found->second, {}};
          kinds.push_back("'" + properties(types[i]).name + "'");
        }
      else
        others.push_back(fmt::format("{} of the type '{}'",
                                     elements[i].size(),
                                     properties(types[i]).name));
    if (!others.empty())
      throw InputError("",
                       path +
                         ": cells other than tetrahedra with 4, 10 or 20 "
                         "nodes: found " +
                         join(others) +
                         "; allowed are 'Tetrahedron 4', 'Tetrahedron 10' and "
                         "'Tetrahedron 20'");
    if (kinds.empty())
      throw InputError("", path + ": the mesh has no tetrahedra");
    if (kinds.size() > 1)
      throw InputError("",
                       path + ": tetrahedra of several degrees: found " +
                         join(kinds) + "; one of these is allowed");
    result.order = node_order(result.type, result.degree);
    return result;
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



  std::vector<std::size_t>
  triangles(const int entity)
  {
    // Of degree 1, 2, 3; corners come first.
    constexpr std::pair<int, unsigned int> types[] = {{2, 3}, {9, 6}, {21, 10}};
    std::vector<std::size_t>               corners;
    for (const auto &[type, n_nodes] : types)
      {
        std::vector<std::size_t> elements, nodes;
        gmsh::model::mesh::getElementsByType(type, elements, nodes, entity);
        for (std::size_t i = 0; i < nodes.size(); i += n_nodes)
          corners.insert(corners.end(), &nodes[i], &nodes[i] + 3);
      }
    return corners;
  }
} // namespace corotet::gmsh_elements
