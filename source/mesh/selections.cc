// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/selections.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

#include "selection.h"

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;
    using dealii::Point;
    using selections::Members;

    /// Pointers to the id of each member.
    using Ids = std::vector<unsigned int *>;



    std::vector<unsigned int>
    values(const Ids &ids)
    {
      std::vector<unsigned int> result;
      result.reserve(ids.size());
      for (const unsigned int *id : ids)
        if (result.empty() || result.back() != *id)
          result.push_back(*id);
      return result;
    }



    bool
    is_meant(const NamedSets &named, const unsigned int id)
    {
      return std::any_of(
        named.sets.begin(), named.sets.end(), [&](const auto &set) {
          return std::binary_search(set.second.begin(), set.second.end(), id);
        });
    }



    // A function that tells which members have an id that a name means. @p
    // unnamed is the id of members without a name, which no name means unless a
    // selection has included them.
    std::function<std::vector<bool>(const std::string &)>
    by_name(const std::string &kind,
            const NamedSets   &named,
            const Ids         &id_of_member,
            const std::string &entry,
            const MPI_Comm     comm,
            const unsigned int unnamed)
    {
      return [=, &named, &id_of_member](const std::string &name) {
        std::vector<unsigned int> used =
          selections::ids_of_all(values(id_of_member), comm);
        if (!is_meant(named, unnamed))
          std::erase(used, unnamed);
        NamedSets known = named;
        known.parts.erase(unnamed);
        known.restrict_to(used);
        const std::vector<unsigned int> ids =
          MeshNames(kind, known).ids(name, entry);
        std::vector<bool> result(id_of_member.size());
        for (std::size_t i = 0; i < result.size(); ++i)
          result[i] =
            std::binary_search(ids.begin(), ids.end(), *id_of_member[i]);
        return result;
      };
    }



    // Does what NamedSets::add() does, for members of all ranks.
    void
    add_on_ranks(NamedSets                      &named,
                 const std::string              &name,
                 const std::vector<std::size_t> &chosen,
                 const Members                  &members,
                 const Ids                      &id_of_member)
    {
      Ids ids_of_set;
      for (const std::size_t i : chosen)
        ids_of_set.push_back(id_of_member[i]);
      const MPI_Comm                  comm = members.communicator;
      const std::vector<unsigned int> ids =
        selections::ids_of_all(values(ids_of_set), comm);
      const auto place_of = [&](const unsigned int id) {
        return std::lower_bound(ids.begin(), ids.end(), id) - ids.begin();
      };
      std::vector<std::uint64_t> n_members(ids.size()), n_in_set(ids.size());
      unsigned int               first_free = 0;
      for (std::size_t i = 0; i < id_of_member.size(); ++i)
        {
          const unsigned int id    = *id_of_member[i];
          const std::size_t  place = place_of(id);
          first_free               = std::max(first_free, id + 1);
          if (members.is_counted[i] && place < ids.size() && ids[place] == id)
            ++n_members[place];
        }
      for (const std::size_t i : chosen)
        if (members.is_counted[i])
          ++n_in_set[place_of(*id_of_member[i])];
      MPI::sum(n_members, comm, n_members);
      MPI::sum(n_in_set, comm, n_in_set);

      std::vector<NamedSets::IdCount> counts;
      for (std::size_t k = 0; k < ids.size(); ++k)
        counts.push_back({ids[k], n_members[k], n_in_set[k]});
      const auto part_of = named.add(name, counts, MPI::max(first_free, comm));
      for (unsigned int *const id : ids_of_set)
        if (const auto part = part_of.find(*id); part != part_of.end())
          *id = part->second;
    }



    void
    select_faces(LocalMesh         &mesh,
                 UsedNames         &names,
                 const GhostCells  &ghosts,
                 const std::string &text,
                 Log               &log)
    {
      const std::string  entry      = "Selections/Boundaries";
      NamedSets         &boundaries = names.boundaries;
      const unsigned int unnamed    = selections::id_without_name(boundaries);
      // The id must not be given to a selection.
      boundaries.names.emplace(unnamed, "");
      selections::Surface surface =
        selections::surface_of(mesh, ghosts, unnamed);
      Ids ids;
      for (CellPart &face : surface.faces)
        ids.push_back(&face.id);
      surface.members.with_name =
        by_name("boundary", boundaries, ids, entry, mesh.communicator, unnamed);
      selections::select_by_names(
        text,
        entry,
        surface.members,
        [&](const std::string &name) {
          return name != std::to_string(unnamed) &&
                 selections::is_place(names, name);
        },
        [&](const std::string &name, const auto &chosen) {
          add_on_ranks(boundaries, name, chosen, surface.members, ids);
        },
        log);

      // Sets also faces of cells beside the own cells that only other ranks
      // know to be on the surface.
      constexpr unsigned int    none = LocalMesh::no_cell;
      std::vector<unsigned int> of_cells(4 * mesh.cells.size(), none);
      const bool                is_kept = is_meant(boundaries, unnamed);
      for (const auto &[c, f, id] : surface.faces)
        if (id != unnamed || is_kept)
          of_cells[4 * c + f] = id;
      ghosts.update(of_cells, 4);
      mesh.faces.clear();
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          if (const unsigned int id = of_cells[4 * c + f]; id != none)
            mesh.faces.push_back({c, f, id});
      std::vector<unsigned int> used = values(ids);
      if (!is_kept)
        std::erase(used, unnamed);
      boundaries.parts.erase(unnamed);
      boundaries.restrict_to(selections::ids_of_all(used, mesh.communicator));
    }



    void
    select_cells(LocalMesh         &mesh,
                 UsedNames         &names,
                 const GhostCells  &ghosts,
                 const std::string &text,
                 Log               &log)
    {
      const std::string entry = "Selections/Regions";
      Members           cells;
      Ids               ids;
      cells.kind         = "cell";
      cells.communicator = mesh.communicator;
      cells.tolerance    = selections::tolerance(mesh);
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        if (mesh.is_owned(c))
          {
            Point<3> centre;
            for (const unsigned int v : mesh.cells[c].vertices)
              centre += mesh.vertices[v] / 4.;
            cells.points.push_back(centre);
            ids.push_back(&mesh.cells[c].region);
          }
      cells.is_counted.assign(ids.size(), true);
      cells.with_name = by_name("region",
                                names.regions,
                                ids,
                                entry,
                                mesh.communicator,
                                dealii::numbers::invalid_unsigned_int);
      selections::select_by_names(
        text,
        entry,
        cells,
        [&](const std::string &name) {
          return !MeshNames("region", names.regions).find(name).empty();
        },
        [&](const std::string &name, const auto &chosen) {
          add_on_ranks(names.regions, name, chosen, cells, ids);
        },
        log);

      ghosts.send<unsigned int>(
        1,
        [&](const unsigned int c, unsigned int *const sent) {
          *sent = mesh.cells[c].region;
        },
        [&](const unsigned int c, const unsigned int *const received) {
          mesh.cells[c].region = *received;
        });
      names.regions.restrict_to(
        selections::ids_of_all(values(ids), mesh.communicator));
    }
  } // namespace



  void
  SelectionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    const std::string shapes =
      "shapes, combined by 'and', 'or', 'not' and parentheses: 'box x y z x y "
      "z' (two opposite corners), 'sphere x y z r', 'cylinder x y z x y z r' "
      "(two ends of the axis, radius), ";
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Names for parts of the surface, chosen by place: 'name: selection, "
      "name: selection'. A selection is made of " +
        shapes +
        "'plane x y z nx ny nz' (point, normal), 'normal nx ny nz [angle]' "
        "(faces whose outer normal has this direction within 5 degrees or an "
        "angle), 'patch x y z [angle]' (the smooth part of the surface that is "
        "nearest to a point, up to edges of 40 degrees or an angle), and names "
        "of boundaries. Coordinates are those of the scaled mesh [m]. A face "
        "is in a shape if all its corners are.");
    prm.add_parameter("Regions",
                      regions,
                      "Names for parts of the body, chosen by place: 'name: "
                      "selection, ...', made of " +
                        shapes +
                        "and names of regions. A cell is in a shape if its "
                        "centre is.");
    const std::string of_faces =
      "'normal' and 'patch' as for Boundaries (what is on such faces)";
    prm.add_parameter(
      "Edges",
      edges,
      "Names for edges of cells on the surface, chosen by place, where the "
      "body is to be supported: 'name: selection, ...', made of " +
        shapes + "'plane x y z nx ny nz', " + of_faces +
        ", 'sharp [angle]' (edges between faces whose normals differ by more "
        "than 40 degrees or an angle), and names of edges, or of boundaries "
        "whose edges are meant. An edge is in a shape if both its ends are.");
    prm.add_parameter("Corners",
                      corners,
                      "Names for vertices of cells, on the surface or inside, "
                      "chosen by place, where the body is to be supported: "
                      "'name: selection, ...', made of " +
                        shapes + "'plane x y z nx ny nz', " + of_faces +
                        ", and names of corners, or of edges or boundaries "
                        "whose vertices are meant.");
  }



  void
  select(LocalMesh                 &mesh,
         UsedNames                 &names,
         const SelectionParameters &parameters,
         Log                       &log)
  {
    if (!parameters.are_given())
      return;
    const GhostCells ghosts(mesh);
    if (!parameters.boundaries.empty())
      select_faces(mesh, names, ghosts, parameters.boundaries, log);
    if (!parameters.regions.empty())
      select_cells(mesh, names, ghosts, parameters.regions, log);
    if (!parameters.edges.empty())
      selections::select_edges(mesh, names, ghosts, parameters.edges, log);
    if (!parameters.corners.empty())
      selections::select_corners(mesh, names, ghosts, parameters.corners, log);
  }
} // namespace corotet
