// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/gmsh_elements.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/gmsh_process.h>
#include <corotet/mesh/surface_mesh.h>
#include <corotet/mesh/triangle_surface.h>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <unordered_map>

#include "nearest_triangle.h"
#include "scratch_folder.h"

namespace corotet
{
  namespace
  {
    using dealii::Point;

    // The number of patches from which nobody has names for them: the angle is
    // too small for a rough scan.
    constexpr std::size_t many_patches = 100;



    // The text of a gmsh file with the surface: an entity for each shell, in
    // the physical group of its body.
    std::string
    msh_text(const TriangleSurface &surface, const SurfaceShells &shells)
    {
      std::string result = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
      auto        text   = std::back_inserter(result);
      std::vector<std::vector<unsigned int>> triangles, vertices;
      std::vector<bool>                      is_known(surface.vertices.size());
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        {
          const std::size_t shell = shells.of_triangle[t];
          triangles.resize(std::max(triangles.size(), shell + 1));
          vertices.resize(triangles.size());
          triangles[shell].push_back(t);
          for (const unsigned int v : surface.triangles[t])
            if (!is_known[v])
              {
                is_known[v] = true;
                vertices[shell].push_back(v);
              }
        }
      const std::size_t         n = triangles.size();
      std::vector<unsigned int> body_of_shell(n);
      for (unsigned int b = 0; b < shells.bodies.size(); ++b)
        for (const unsigned int shell : shells.bodies[b].shells)
          body_of_shell[shell] = b;
      fmt::format_to(text, "$Entities\n0 0 {} 0\n", n);
      for (std::size_t shell = 0; shell < n; ++shell)
        fmt::format_to(text,
                       "{} 0 0 0 0 0 0 1 {} 0\n",
                       shell + 1,
                       body_of_shell[shell] + 1);
      fmt::format_to(text,
                     "$EndEntities\n$Nodes\n{} {} 1 {}\n",
                     n,
                     surface.vertices.size(),
                     surface.vertices.size());
      for (std::size_t shell = 0; shell < n; ++shell)
        {
          fmt::format_to(text,
                         "2 {} 0 {}\n",
                         shell + 1,
                         vertices[shell].size());
          for (const unsigned int v : vertices[shell])
            fmt::format_to(text, "{}\n", v + 1);
          for (const unsigned int v : vertices[shell])
            fmt::format_to(text,
                           "{} {} {}\n",
                           surface.vertices[v][0],
                           surface.vertices[v][1],
                           surface.vertices[v][2]);
        }
      fmt::format_to(text,
                     "$EndNodes\n$Elements\n{} {} 1 {}\n",
                     n,
                     surface.triangles.size(),
                     surface.triangles.size());
      for (std::size_t shell = 0; shell < n; ++shell)
        {
          fmt::format_to(text,
                         "2 {} 2 {}\n",
                         shell + 1,
                         triangles[shell].size());
          for (const unsigned int t : triangles[shell])
            fmt::format_to(text,
                           "{} {} {} {}\n",
                           t + 1,
                           surface.triangles[t][0] + 1,
                           surface.triangles[t][1] + 1,
                           surface.triangles[t][2] + 1);
        }
      fmt::format_to(text, "$EndElements\n");
      return result;
    }



    // Adds groups of entities of one dimension for the names of each entity. An
    // entity without names is called @p kind and its number, or similar if the
    // file has that name already.
    void
    add_groups(GmshModel                                   &model,
               const int                                    dimension,
               const std::string                           &kind,
               const std::vector<std::vector<std::string>> &names)
    {
      int next = static_cast<int>(names.size());
      std::map<std::string, std::vector<int>> entities;
      for (std::size_t i = 0; i < names.size(); ++i)
        for (const std::string &name : names[i])
          entities[name].push_back(static_cast<int>(i) + 1);
      const auto is_taken = [&](const std::string &name) {
        return entities.contains(name);
      };
      for (int entity = 1; entity <= next; ++entity)
        model.groups.push_back(
          {dimension,
           entity,
           unused_name(kind + ' ' + std::to_string(entity), is_taken),
           {entity}});
      for (const auto &[name, of_name] : entities)
        model.groups.push_back({dimension, ++next, name, of_name});
    }



    // The names of the bodies: those that all triangles around a body have in
    // common.
    std::vector<std::vector<std::string>>
    names_of_bodies(const TriangleSurface &surface, const SurfaceShells &shells)
    {
      std::vector<std::vector<std::string>> result;
      std::vector<std::set<unsigned int>>   groups;
      for (unsigned int t = 0; t < surface.triangles.size(); ++t)
        {
          groups.resize(
            std::max<std::size_t>(groups.size(), shells.of_triangle[t] + 1));
          groups[shells.of_triangle[t]].insert(surface.groups[t]);
        }
      for (const SurfaceBody &body : shells.bodies)
        {
          const std::set<unsigned int> &around = groups[body.shells[0]];
          std::vector<std::string>      names  = surface.names[*around.begin()];
          for (const unsigned int group : around)
            std::erase_if(names, [&](const std::string &name) {
              const std::vector<std::string> &of_group = surface.names[group];
              return std::find(of_group.begin(), of_group.end(), name) ==
                     of_group.end();
            });
          result.push_back(names);
        }
      return result;
    }



    // Gives each face of the cells on the surface the patch that it lies on.
    void
    name_faces(GmshModel                       &model,
               const TriangleSurface           &surface,
               const std::vector<unsigned int> &patches)
    {
      std::unordered_map<std::uint64_t, std::size_t> positions;
      for (std::size_t i = 0; i < model.node_tags.size(); ++i)
        positions.emplace(model.node_tags[i], i);
      const NearestTriangle                              nearest(surface);
      std::map<std::pair<int, int>, GmshModel::Elements> by_patch;
      for (const GmshModel::Elements &elements : model.surfaces)
        {
          const std::size_t n = gmsh_elements::triangle_nodes.at(elements.type);
          for (std::size_t i = 0; i + n <= elements.nodes.size(); i += n)
            {
              dealii::Tensor<1, 3> centre;
              for (std::size_t k = 0; k < 3; ++k)
                {
                  const auto found = positions.find(elements.nodes[i + k]);
                  if (found == positions.end())
                    throw InputError("",
                                     surface.origin +
                                       ": gmsh has handed back a triangle "
                                       "without corners");
                  for (unsigned int d = 0; d < 3; ++d)
                    centre[d] += model.coordinates[3 * found->second + d] / 3;
                }
              const int patch =
                static_cast<int>(patches[nearest(Point<3>(centre))]) + 1;
              GmshModel::Elements &of_patch = by_patch[{patch, elements.type}];
              of_patch.entity               = patch;
              of_patch.type                 = elements.type;
              of_patch.nodes.insert(of_patch.nodes.end(),
                                    elements.nodes.begin() + i,
                                    elements.nodes.begin() + i + n);
            }
        }
      model.surfaces.clear();
      for (auto &[key, elements] : by_patch)
        model.surfaces.push_back(std::move(elements));
      std::vector<std::vector<std::string>> names;
      for (unsigned int t = 0; t < patches.size(); ++t)
        if (patches[t] == names.size())
          names.push_back(surface.names[surface.groups[t]]);
      add_groups(model, 2, "surface", names);
    }
  } // namespace



  SerialMesh
  mesh_of_surface(const GmshRequest &request, const MeshFormat format)
  {
    TriangleSurface surface = read_triangle_file(request.path, format);
    mend_surface(surface);
    check_intersections(surface);
    const std::vector<SurfaceEdge>  edges  = surface_edges(surface);
    const SurfaceShells             shells = surface_shells(surface, edges);
    const std::vector<unsigned int> patches =
      surface_patches(surface, edges, request.feature_angle);

    const ScratchFolder folder;
    GmshRequest         inner = request;
    inner.path                = folder.path("surface.msh");
    inner.format              = "surface";
    write_whole_file(inner.path, msh_text(surface, shells), "the surface");
    GmshModel model = run_gmsh(inner, request.path);
    model.groups.clear();
    name_faces(model, surface, patches);
    add_groups(model, 3, "solid", names_of_bodies(surface, shells));
    SerialMesh mesh = mesh_of_model(model, request.path, true);
    mesh.remarks.insert(mesh.remarks.begin(),
                        surface.remarks.begin(),
                        surface.remarks.end());
    const std::size_t n_patches =
      1 + *std::max_element(patches.begin(), patches.end());
    if (n_patches > many_patches)
      mesh.remarks.push_back(
        fmt::format("the surface has {} patches between edges of more than {} "
                    "degrees; a larger Mesh/file/Feature angle gives fewer",
                    n_patches,
                    request.feature_angle));
    return mesh;
  }
} // namespace corotet
