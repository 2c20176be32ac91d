// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Selections of edges and of corners.

#include <corotet/mesh/edges.h>

#include <algorithm>

#include "selection.h"

namespace corotet::selections
{
  namespace
  {
    using Ends = std::array<unsigned int, 2>;
    /// The ids of the names of each member.
    using Ids = std::vector<std::vector<unsigned int>>;



    bool
    contains(const std::vector<unsigned int> &ids, const unsigned int id)
    {
      return std::binary_search(ids.begin(), ids.end(), id);
    }



    bool
    have_one_in_common(const std::vector<unsigned int> &ids,
                       const std::vector<unsigned int> &sorted)
    {
      return std::any_of(ids.begin(), ids.end(), [&](const unsigned int id) {
        return contains(sorted, id);
      });
    }



    PlaceNames
    place_names(const UsedNames &names)
    {
      return PlaceNames(names.boundaries, names.edges, names.corners);
    }



    // Whether each member belongs to a face of these boundaries.
    std::vector<bool>
    on_boundaries(const Members                   &members,
                  const Surface                   &surface,
                  const std::vector<unsigned int> &boundaries)
    {
      std::vector<bool> result(members.size());
      for (std::size_t i = 0; i < result.size(); ++i)
        for (const unsigned int f : members.faces[i])
          if (contains(boundaries, surface.faces[f].id))
            result[i] = true;
      return result;
    }



    // Gives members a name with a new id.
    void
    add_name(NamedSets                      &named,
             const std::string              &name,
             const std::vector<std::size_t> &chosen,
             Ids                            &ids)
    {
      const unsigned int id = id_without_name(named);
      named.names[id]       = name;
      for (const std::size_t i : chosen)
        ids[i].push_back(id);
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



    // The edges of a surface, ascending, and their data as members of
    // selections.
    std::vector<Ends>
    edges_of(const LocalMesh &mesh, const Surface &surface, Members &members)
    {
      std::vector<std::array<unsigned int, 3>> sides;
      const std::vector<bool> is_near = vertices_of_own_cells(mesh);
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        {
          const auto v = vertices_of(mesh, surface.faces[f]);
          for (unsigned int i = 0; i < 3; ++i)
            {
              const auto [a, b] = ascending_ends(v[i], v[(i + 1) % 3]);
              if (is_near[a] && is_near[b])
                sides.push_back({{a, b, f}});
            }
        }
      std::sort(sides.begin(), sides.end());
      members.kind         = "edge";
      members.communicator = mesh.communicator;
      members.n_points     = 2;
      members.has_angles   = true;
      members.surface      = &surface.members;
      members.tolerance    = surface.members.tolerance;
      std::vector<Ends> edges;
      for (const auto &[a, b, f] : sides)
        {
          if (const Ends ends{{a, b}}; edges.empty() || edges.back() != ends)
            {
              edges.push_back(ends);
              members.points.push_back(mesh.vertices[a]);
              members.points.push_back(mesh.vertices[b]);
              members.faces.emplace_back();
            }
          members.faces.back().push_back(f);
        }
      for (const std::vector<unsigned int> &faces : members.faces)
        {
          members.angles.push_back(angle_between(surface.members, faces));
          // The rank that owns the first cell with such a face counts the edge.
          members.is_counted.push_back(
            mesh.is_owned(surface.faces[faces[0]].cell));
        }
      return edges;
    }



    // Calls action(number of the member, cell, number in the cell) for those
    // edges of own cells that are members.
    template <typename Action>
    void
    for_each_edge(const LocalMesh         &mesh,
                  const std::vector<Ends> &edges,
                  const Action            &action)
    {
      std::vector<bool> is_end(mesh.vertices.size(), false);
      for (const auto &[a, b] : edges)
        is_end[a] = is_end[b] = true;
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int e = 0; mesh.is_owned(c) && e < 6; ++e)
          {
            const auto &[i, j] = ends_of_edges[e];
            const Ends ends    = ascending_ends(mesh.cells[c].vertices[i],
                                             mesh.cells[c].vertices[j]);
            if (!is_end[ends[0]] || !is_end[ends[1]])
              continue;
            const auto edge =
              std::lower_bound(edges.begin(), edges.end(), ends);
            if (edge != edges.end() && *edge == ends)
              action(edge - edges.begin(), c, e);
          }
    }



    // The corners, which are all vertices of own cells, as members of
    // selections.
    Members
    corners_of(const LocalMesh &mesh, const Surface &surface)
    {
      Members members;
      members.kind         = "corner";
      members.communicator = mesh.communicator;
      members.surface      = &surface.members;
      members.tolerance    = surface.members.tolerance;
      members.points       = mesh.vertices;
      members.faces.resize(mesh.vertices.size());
      for (unsigned int f = 0; f < surface.faces.size(); ++f)
        for (const unsigned int v : vertices_of(mesh, surface.faces[f]))
          members.faces[v].push_back(f);
      // The rank that owns the first cell with a vertex counts it.
      members.is_counted.resize(mesh.vertices.size());
      std::vector<bool> is_known(mesh.vertices.size(), false);
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (const unsigned int v : mesh.cells[c].vertices)
          if (!is_known[v])
            {
              is_known[v]           = true;
              members.is_counted[v] = mesh.is_owned(c);
            }
      return members;
    }



    // Whether each vertex is at the end of an edge, on any rank, with one of
    // these ids.
    std::vector<bool>
    ends_of_named_edges(const LocalMesh                 &mesh,
                        const GhostCells                &ghosts,
                        const std::vector<unsigned int> &ids)
    {
      std::vector<bool> result(mesh.vertices.size(), false);
      for (const auto &[c, e, id] : mesh.edges)
        if (contains(ids, id))
          for (const unsigned int k : ends_of_edges[e])
            result[mesh.cells[c].vertices[k]] = true;
      ghosts.send<unsigned char>(
        4,
        [&](const unsigned int c, unsigned char *const sent) {
          for (unsigned int k = 0; k < 4; ++k)
            sent[k] = result[mesh.cells[c].vertices[k]] ? 1 : 0;
        },
        [&](const unsigned int c, const unsigned char *const received) {
          for (unsigned int k = 0; k < 4; ++k)
            if (received[k])
              result[mesh.cells[c].vertices[k]] = true;
        });
      return result;
    }



    void
    sort_by_cells(std::vector<CellPart> &parts)
    {
      std::ranges::stable_sort(parts, {}, &CellPart::cell);
    }
  } // namespace



  void
  select_edges(LocalMesh         &mesh,
               UsedNames         &names,
               const GhostCells  &ghosts,
               const std::string &text,
               Log               &log)
  {
    const std::string entry = "Selections/Edges";
    const Surface     surface =
      surface_of(mesh, ghosts, id_without_name(names.boundaries));
    Members                 members;
    const std::vector<Ends> edges = edges_of(mesh, surface, members);
    Ids                     ids(edges.size());
    for_each_edge(mesh, edges, [&](const auto i, const auto c, const auto e) {
      for (auto part =
             std::ranges::lower_bound(mesh.edges, c, {}, &CellPart::cell);
           part != mesh.edges.end() && part->cell == c;
           ++part)
        if (part->number == e)
          ids[i].push_back(part->id);
    });
    members.with_name = [&](const std::string &name) {
      const Place       place = place_names(names).find(name, entry);
      std::vector<bool> result =
        on_boundaries(members, surface, place.boundaries);
      for (std::size_t i = 0; i < edges.size(); ++i)
        if (have_one_in_common(ids[i], place.edges))
          result[i] = true;
      return result;
    };
    const unsigned int first_new = id_without_name(names.edges);
    select_by_names(
      text,
      entry,
      members,
      [&](const std::string &name) { return is_place(names, name); },
      [&](const std::string &name, const auto &chosen) {
        add_name(names.edges, name, chosen, ids);
      },
      log);
    for_each_edge(mesh, edges, [&](const auto i, const auto c, const auto e) {
      for (const unsigned int id : ids[i])
        if (id >= first_new)
          mesh.edges.push_back({c, e, id});
    });
    sort_by_cells(mesh.edges);
  }



  void
  select_corners(LocalMesh         &mesh,
                 UsedNames         &names,
                 const GhostCells  &ghosts,
                 const std::string &text,
                 Log               &log)
  {
    const std::string entry = "Selections/Corners";
    const Surface     surface =
      surface_of(mesh, ghosts, id_without_name(names.boundaries));
    Members members = corners_of(mesh, surface);
    Ids     ids(mesh.vertices.size());
    for (const auto &[c, k, id] : mesh.corners)
      ids[mesh.cells[c].vertices[k]].push_back(id);
    members.with_name = [&](const std::string &name) {
      const Place       place = place_names(names).find(name, entry);
      std::vector<bool> result =
        on_boundaries(members, surface, place.boundaries);
      const std::vector<bool> is_end =
        ends_of_named_edges(mesh, ghosts, place.edges);
      for (std::size_t v = 0; v < result.size(); ++v)
        if (is_end[v] || have_one_in_common(ids[v], place.corners))
          result[v] = true;
      return result;
    };
    const unsigned int first_new = id_without_name(names.corners);
    select_by_names(
      text,
      entry,
      members,
      [&](const std::string &name) { return is_place(names, name); },
      [&](const std::string &name, const auto &chosen) {
        add_name(names.corners, name, chosen, ids);
      },
      log);
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int k = 0; mesh.is_owned(c) && k < 4; ++k)
        for (const unsigned int id : ids[mesh.cells[c].vertices[k]])
          if (id >= first_new)
            mesh.corners.push_back({c, k, id});
    sort_by_cells(mesh.corners);
  }
} // namespace corotet::selections
