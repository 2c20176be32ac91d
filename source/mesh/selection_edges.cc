// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Names by place of edges and of corners.

#include <corotet/mesh/edges.h>

#include <algorithm>
#include <map>

#include "selection.h"

namespace corotet::selections
{
  namespace
  {
    using Ends = std::array<unsigned int, 2>;



    // Ids in use of what has names on the surface.
    PlaceNames
    names_in_use(const SerialMesh &mesh)
    {
      std::vector<unsigned int> boundaries, edges, corners;
      for (const SerialMesh::Face &face : mesh.faces)
        boundaries.push_back(face.boundary);
      for (const SerialMesh::Edge &edge : mesh.edges)
        edges.push_back(edge.id);
      for (const SerialMesh::Corner &corner : mesh.corners)
        corners.push_back(corner.id);
      NamedSets sets[]{mesh.boundaries, mesh.edge_names, mesh.corner_names};
      sets[0].restrict_to(boundaries);
      sets[1].restrict_to(edges);
      sets[2].restrict_to(corners);
      return PlaceNames(sets[0], sets[1], sets[2]);
    }



    bool
    contains(const std::vector<unsigned int> &ids, const unsigned int id)
    {
      return std::binary_search(ids.begin(), ids.end(), id);
    }



    // Members that belong to faces of some boundaries.
    std::vector<bool>
    on_boundaries(const Members                   &members,
                  const Surface                   &surface,
                  const std::vector<unsigned int> &boundaries)
    {
      std::vector<bool> result(members.points.size());
      for (std::size_t i = 0; i < result.size(); ++i)
        for (const unsigned int f : members.faces[i])
          if (contains(boundaries, surface.faces[f].boundary))
            result[i] = true;
      return result;
    }



    // A new id with a name.
    unsigned int
    add_name(NamedSets &named, const std::string &name)
    {
      unsigned int id = 0;
      for (const auto &[other, own] : named.names)
        id = std::max(id, other + 1);
      named.names[id] = name;
      return id;
    }



    // The greatest angle between two of the faces at an edge.
    double
    angle_between(const Members                   &surface,
                  const std::vector<unsigned int> &faces)
    {
      double result = 0;
      for (const unsigned int f : faces)
        for (const unsigned int g : faces)
          if (f < g)
            result =
              std::max(result,
                       degrees_between(surface.normals[f], surface.normals[g]));
      return result;
    }



    // The edges of a surface, and what selections know of them.
    std::vector<Ends>
    edges_of(const SerialMesh &mesh, const Surface &surface, Members &members)
    {
      std::map<Ends, std::vector<unsigned int>> faces;
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          faces[ascending_ends(surface.faces[f].vertices[i],
                               surface.faces[f].vertices[(i + 1) % 3])]
            .push_back(f);
      members.kind      = "edge";
      members.surface   = &surface.members;
      members.tolerance = surface.members.tolerance;
      std::vector<Ends> edges;
      for (const auto &[ends, of_edge] : faces)
        {
          edges.push_back(ends);
          members.points.push_back(
            {mesh.vertices[ends[0]], mesh.vertices[ends[1]]});
          members.faces.push_back(of_edge);
          members.angles.push_back(angle_between(surface.members, of_edge));
        }
      return edges;
    }
  } // namespace



  void
  select_edges(SerialMesh &mesh, const std::string &text, Log &log)
  {
    const std::string       entry   = "Selections/Edges";
    const Surface           surface = surface_of(mesh, id_without_name(mesh));
    Members                 members;
    const std::vector<Ends> edges = edges_of(mesh, surface, members);
    members.with_name             = [&](const std::string &name) {
      const Place       place = names_in_use(mesh).find(name, entry);
      std::vector<bool> result =
        on_boundaries(members, surface, place.boundaries);
      const PartsOfCells known(mesh);
      for (std::size_t i = 0; i < edges.size(); ++i)
        for (const std::size_t e :
             known.edges_between(edges[i][0], edges[i][1]))
          if (contains(place.edges, mesh.edges[e].id))
            result[i] = true;
      return result;
    };
    select_by_names(
      text,
      entry,
      members,
      [&](const std::string &name) { return is_place(mesh, name); },
      [&](const std::string &name, const auto &chosen) {
        const unsigned int id = add_name(mesh.edge_names, name);
        for (const std::size_t i : chosen)
          mesh.edges.push_back({edges[i], id});
      },
      log);
  }



  void
  select_corners(SerialMesh &mesh, const std::string &text, Log &log)
  {
    const std::string entry   = "Selections/Corners";
    const Surface     surface = surface_of(mesh, id_without_name(mesh));
    Members           members;
    members.kind      = "corner";
    members.surface   = &surface.members;
    members.tolerance = surface.members.tolerance;
    members.faces.resize(mesh.vertices.size());
    for (unsigned int f = 0; f < surface.faces.size(); ++f)
      for (const unsigned int v : surface.faces[f].vertices)
        members.faces[v].push_back(f);
    for (const dealii::Point<3> &x : mesh.vertices)
      members.points.push_back({x});
    members.with_name = [&](const std::string &name) {
      const Place       place = names_in_use(mesh).find(name, entry);
      std::vector<bool> result =
        on_boundaries(members, surface, place.boundaries);
      for (const auto &[ends, id] : mesh.edges)
        if (contains(place.edges, id))
          for (const unsigned int v : ends)
            result[v] = true;
      for (const auto &[vertex, id] : mesh.corners)
        if (contains(place.corners, id))
          result[vertex] = true;
      return result;
    };
    select_by_names(
      text,
      entry,
      members,
      [&](const std::string &name) { return is_place(mesh, name); },
      [&](const std::string &name, const auto &chosen) {
        const unsigned int id = add_name(mesh.corner_names, name);
        for (const std::size_t v : chosen)
          mesh.corners.push_back({static_cast<unsigned int>(v), id});
      },
      log);
  }
} // namespace corotet::selections
