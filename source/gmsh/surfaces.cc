// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "surfaces.h"

#include <gmsh.h>

#include <map>
#include <numbers>
#include <set>
#include <stdexcept>

namespace corotet::gmsh_program
{
  namespace
  {
    // The surfaces that each closed surface was divided into, by its number.
    using Patches = std::map<int, std::vector<int>>;



    // The closed surfaces of each body, which form a physical group.
    std::vector<std::vector<int>>
    bodies()
    {
      std::vector<std::vector<int>> result;
      gmsh::vectorpair              groups;
      gmsh::model::getPhysicalGroups(groups, 2);
      for (const auto &[dimension, group] : groups)
        gmsh::model::getEntitiesForPhysicalGroup(dimension,
                                                 group,
                                                 result.emplace_back());
      return result;
    }



    // Divides the surfaces at their edges, and further where parts could not be
    // laid out flat, and gives the parts parameters.
    Patches
    divide(const double feature_angle)
    {
      // Nodes keep their numbers, so a node of a part tells which surface it
      // comes from.
      std::map<std::size_t, int> surface_of_node;
      gmsh::vectorpair           surfaces;
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &[dimension, tag] : surfaces)
        {
          std::vector<std::size_t> nodes;
          std::vector<double>      coordinates, parameters;
          gmsh::model::mesh::getNodes(
            nodes, coordinates, parameters, dimension, tag);
          for (const std::size_t node : nodes)
            surface_of_node[node] = tag;
        }
      gmsh::model::mesh::classifySurfaces(
        feature_angle * std::numbers::pi / 180, true, true, std::numbers::pi);
      Patches result;
      gmsh::model::getEntities(surfaces, 2);
      for (const auto &[dimension, tag] : surfaces)
        {
          std::vector<std::size_t> triangles, nodes;
          gmsh::model::mesh::getElementsByType(2, triangles, nodes, tag);
          if (nodes.empty() || !surface_of_node.contains(nodes[0]))
            throw std::runtime_error("a part has no triangle");
          result[surface_of_node[nodes[0]]].push_back(tag);
        }
      gmsh::model::mesh::createGeometry();
      return result;
    }
  } // namespace



  void
  explain_surface(const GmshRequest &request, const std::runtime_error &error)
  {
    const std::string what = error.what();
    if (request.element_size > 0)
      throw std::runtime_error("the surface cannot get triangles of another "
                               "size (" +
                               what +
                               "); try another feature angle, or element size "
                               "0, which keeps its triangles");
    throw std::runtime_error("the surface cannot be filled with cells (" +
                             what + ")");
  }



  void
  read_surface(const GmshRequest &request)
  {
    gmsh::open(request.path);
    const std::vector<std::vector<int>> shells = bodies();
    Patches                             patches;
    if (request.element_size > 0)
      patches = divide(request.feature_angle);
    else
      for (const std::vector<int> &surfaces : shells)
        for (const int surface : surfaces)
          patches[surface] = {surface};
    for (const std::vector<int> &surfaces : shells)
      {
        std::vector<int> loops;
        for (const int surface : surfaces)
          loops.push_back(gmsh::model::geo::addSurfaceLoop(patches[surface]));
        gmsh::model::geo::addVolume(loops);
      }
    gmsh::model::geo::synchronize();
  }
} // namespace corotet::gmsh_program
