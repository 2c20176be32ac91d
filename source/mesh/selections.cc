// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/facets.h>
#include <corotet/mesh/selections.h>

#include <algorithm>

#include "selection.h"

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using selections::Members;



    bool
    is_meant(const NamedSets &named, const unsigned int id)
    {
      return std::any_of(
        named.sets.begin(), named.sets.end(), [&](const auto &set) {
          return std::binary_search(set.second.begin(), set.second.end(), id);
        });
    }



    // Which members have an id that a name means. @p unnamed: of those that
    // have no name, unless a selection means them.
    template <typename Id>
    std::function<std::vector<bool>(const std::string &)>
    by_name(const std::string &kind,
            const NamedSets   &named,
            const std::size_t  n,
            const std::string &entry,
            const Id          &id,
            const unsigned int unnamed = no_boundary)
    {
      return [=, &named](const std::string &name) {
        NamedSets                 known = named;
        std::vector<unsigned int> used;
        const bool                has_unnamed = is_meant(named, unnamed);
        for (std::size_t i = 0; i < n; ++i)
          if (id(i) != unnamed || has_unnamed)
            used.push_back(id(i));
        known.restrict_to(used);
        const std::vector<unsigned int> ids =
          MeshNames(kind, known).ids(name, entry);
        std::vector<bool> result(n);
        for (std::size_t i = 0; i < n; ++i)
          result[i] = std::binary_search(ids.begin(), ids.end(), id(i));
        return result;
      };
    }



    void
    select_faces(SerialMesh &mesh, const std::string &text, Log &log)
    {
      const std::string  entry   = "Selections/Boundaries";
      const unsigned int unnamed = selections::id_without_name(mesh);
      // No selection gets this id.
      mesh.boundaries.names.emplace(unnamed, "");
      selections::Surface surface = selections::surface_of(mesh, unnamed);
      mesh.faces                  = std::move(surface.faces);
      std::vector<unsigned int *> ids;
      for (SerialMesh::Face &face : mesh.faces)
        ids.push_back(&face.boundary);
      surface.members.with_name = by_name(
        "boundary",
        mesh.boundaries,
        ids.size(),
        entry,
        [&ids](const std::size_t i) { return *ids[i]; },
        unnamed);
      selections::select_by_names(
        text,
        entry,
        surface.members,
        [&](const std::string &name) {
          return selections::is_place(mesh, name);
        },
        [&](const std::string &name, const auto &chosen) {
          mesh.boundaries.add(name, chosen, ids);
        },
        log);
      if (!is_meant(mesh.boundaries, unnamed))
        std::erase_if(mesh.faces, [&](const SerialMesh::Face &face) {
          return face.boundary == unnamed;
        });
    }



    void
    select_cells(SerialMesh &mesh, const std::string &text, Log &log)
    {
      const std::string           entry = "Selections/Regions";
      Members                     cells;
      std::vector<unsigned int *> ids;
      cells.kind      = "cell";
      cells.tolerance = selections::tolerance(mesh);
      for (SerialMesh::Cell &cell : mesh.cells)
        {
          Point<3> centre;
          for (const unsigned int v : cell.vertices)
            centre += mesh.vertices[v] / 4.;
          cells.points.push_back({centre});
          ids.push_back(&cell.region);
        }
      cells.with_name =
        by_name("region",
                mesh.regions,
                ids.size(),
                entry,
                [&ids](const std::size_t i) { return *ids[i]; });
      selections::select_by_names(
        text,
        entry,
        cells,
        [&](const std::string &name) {
          return !mesh.regions.ids(name).empty();
        },
        [&](const std::string &name, const auto &chosen) {
          mesh.regions.add(name, chosen, ids);
        },
        log);
    }
  } // namespace



  void
  SelectionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    const std::string shapes =
      "shapes, combined by 'and', 'or', 'not' and (): 'box x y z x y z', "
      "'sphere x y z r', 'cylinder x y z x y z r', ";
    prm.add_parameter(
      "Boundaries",
      boundaries,
      "Boundaries by place: 'name: selection, name: selection' of " + shapes +
        "'plane x y z nx ny nz' [m], 'normal nx ny nz [angle]' (5 degrees), "
        "'patch x y z [angle]' (the smooth patch nearest to a point, up to "
        "edges of 40 degrees), and names. Faces with all corners there.");
    prm.add_parameter("Regions",
                      regions,
                      "Regions by place, in the same way: " + shapes +
                        "and names. Cells with their centre there.");
    const std::string of_faces =
      "'normal' and 'patch' (of faces with such a normal or of the patch)";
    prm.add_parameter(
      "Edges",
      edges,
      "Edges by place, for supports: " + shapes + "'plane x y z nx ny nz', " +
        of_faces +
        ", 'sharp [angle]' (between faces whose normals differ by "
        "more than 40 degrees), and names of edges or of boundaries that they "
        "are edges of. Edges of cells, on the surface, with both ends there.");
    prm.add_parameter("Corners",
                      corners,
                      "Vertices of cells by place, for supports: " + shapes +
                        "'plane x y z nx ny nz', " + of_faces +
                        ", and names of corners, or of edges or boundaries "
                        "that they are on.");
  }



  void
  select(SerialMesh &mesh, const SelectionParameters &parameters, Log &log)
  {
    if (!parameters.boundaries.empty())
      select_faces(mesh, parameters.boundaries, log);
    if (!parameters.regions.empty())
      select_cells(mesh, parameters.regions, log);
    if (!parameters.edges.empty())
      selections::select_edges(mesh, parameters.edges, log);
    if (!parameters.corners.empty())
      selections::select_corners(mesh, parameters.corners, log);
  }
} // namespace corotet
