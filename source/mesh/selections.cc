// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/selections.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "selection.h"

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using selections::Members;
    using Triangle = std::array<unsigned int, 3>;



    Triangle
    sorted(Triangle triangle)
    {
      std::sort(triangle.begin(), triangle.end());
      return triangle;
    }



    // Adds to the faces of a mesh all others of its surface, with an id that no
    // boundary has. Returns the vertex inside of each.
    std::vector<unsigned int>
    add_whole_surface(SerialMesh &mesh, const unsigned int unnamed)
    {
      struct Side
      {
        Triangle     vertices;
        unsigned int inside;
      };
      std::vector<Side> sides;
      sides.reserve(4 * mesh.cells.size());
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (unsigned int i = 0; i < 4; ++i)
          sides.push_back({sorted({{cell.vertices[(i + 1) % 4],
                                    cell.vertices[(i + 2) % 4],
                                    cell.vertices[(i + 3) % 4]}}),
                           cell.vertices[i]});
      std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
        return a.vertices < b.vertices;
      });
      std::map<Triangle, std::size_t> known;
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        known.emplace(sorted(mesh.faces[f].vertices), f);
      std::vector<unsigned int> inside(mesh.faces.size());
      for (std::size_t i = 0; i < sides.size(); ++i)
        {
          if (i + 1 < sides.size() &&
              sides[i].vertices == sides[i + 1].vertices)
            {
              ++i;
              continue;
            }
          if (const auto found = known.find(sides[i].vertices);
              found != known.end())
            inside[found->second] = sides[i].inside;
          else
            {
              mesh.faces.push_back({sides[i].vertices, unnamed});
              inside.push_back(sides[i].inside);
            }
        }
      return inside;
    }



    // Faces that share an edge.
    std::vector<std::vector<unsigned int>>
    neighbours(const SerialMesh &mesh)
    {
      std::vector<Triangle> halves;
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int a = mesh.faces[f].vertices[i];
            const unsigned int b = mesh.faces[f].vertices[(i + 1) % 3];
            halves.push_back({{std::min(a, b), std::max(a, b), f}});
          }
      std::sort(halves.begin(), halves.end());
      std::vector<std::vector<unsigned int>> result(mesh.faces.size());
      for (std::size_t i = 0; i + 1 < halves.size(); ++i)
        if (halves[i][0] == halves[i + 1][0] &&
            halves[i][1] == halves[i + 1][1])
          {
            result[halves[i][2]].push_back(halves[i + 1][2]);
            result[halves[i + 1][2]].push_back(halves[i][2]);
          }
      return result;
    }



    double
    tolerance(const SerialMesh &mesh)
    {
      const dealii::BoundingBox<3> box(mesh.vertices);
      const auto [low, high] = box.get_boundary_points();
      return 1e-6 * low.distance(high);
    }



    // Which members have an id that a name means.
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
        for (std::size_t i = 0; i < n; ++i)
          if (id(i) != unnamed)
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



    [[noreturn]] void
    refuse_nothing(const std::string          &name,
                   const selections::Selected &selected,
                   const Members              &members,
                   const std::string          &entry)
    {
      std::string reasons;
      for (const selections::Shape &shape : selected.shapes)
        {
          const double nearest =
            *std::min_element(shape.distances.begin(), shape.distances.end());
          reasons +=
            fmt::format("; the nearest to '{}' is {}",
                        shape.text,
                        nearest <= 0 ?
                          "inside" :
                          fmt::format("{:.4g} {} away", nearest, shape.unit));
        }
      throw InputError(
        entry,
        fmt::format("selection '{}' has no {}{}", name, members.kind, reasons));
    }



    // Names the members of selections. @p id_of_member: of each.
    void
    name_members(const std::string                 &text,
                 const std::string                 &entry,
                 const Members                     &members,
                 const std::vector<unsigned int *> &id_of_member,
                 NamedSets                         &named,
                 Log                               &log)
    {
      for (const auto &[name, selection] :
           named_values(text, entry, "'name: selection, name: selection'"))
        {
          if (!named.ids(name).empty())
            throw InputError(entry,
                             fmt::format("the mesh has this name, or another "
                                         "selection: found '{}'; give another "
                                         "one",
                                         name));
          const selections::Selected selected =
            selections::select(selection, members, entry);
          std::vector<std::size_t> chosen;
          for (std::size_t i = 0; i < id_of_member.size(); ++i)
            if (selected.is_member[i])
              chosen.push_back(i);
          if (chosen.empty())
            refuse_nothing(name, selected, members, entry);
          named.add(name, chosen, id_of_member);
          log.line(fmt::format(
            "  selection '{}': {} {}s", name, chosen.size(), members.kind));
        }
    }



    void
    select_faces(SerialMesh &mesh, const std::string &text, Log &log)
    {
      const std::string entry   = "Selections/Boundaries";
      unsigned int      unnamed = 0;
      for (const SerialMesh::Face &face : mesh.faces)
        unnamed = std::max(unnamed, face.boundary + 1);
      for (const auto &[id, name] : mesh.boundaries.names)
        unnamed = std::max(unnamed, id + 1);
      // No selection gets this id.
      mesh.boundaries.names.emplace(unnamed, "");
      const std::vector<unsigned int> inside = add_whole_surface(mesh, unnamed);
      Members                         faces;
      std::vector<unsigned int *>     ids;
      faces.kind       = "face";
      faces.tolerance  = tolerance(mesh);
      faces.neighbours = neighbours(mesh);
      for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        {
          std::vector<Point<3>> x;
          for (const unsigned int v : mesh.faces[f].vertices)
            x.push_back(mesh.vertices[v]);
          auto normal = dealii::cross_product_3d(x[1] - x[0], x[2] - x[0]);
          if (normal * (mesh.vertices[inside[f]] - x[0]) > 0)
            normal *= -1;
          faces.normals.push_back(normal / normal.norm());
          faces.points.push_back(x);
          ids.push_back(&mesh.faces[f].boundary);
        }
      faces.with_name = by_name(
        "boundary",
        mesh.boundaries,
        ids.size(),
        entry,
        [&ids](const std::size_t i) { return *ids[i]; },
        unnamed);
      name_members(text, entry, faces, ids, mesh.boundaries, log);
      const bool is_meant =
        std::any_of(mesh.boundaries.sets.begin(),
                    mesh.boundaries.sets.end(),
                    [&](const auto &set) {
                      return std::binary_search(set.second.begin(),
                                                set.second.end(),
                                                unnamed);
                    });
      if (!is_meant)
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
      cells.tolerance = tolerance(mesh);
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
      name_members(text, entry, cells, ids, mesh.regions, log);
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
  }



  void
  select(SerialMesh &mesh, const SelectionParameters &parameters, Log &log)
  {
    if (!parameters.boundaries.empty())
      select_faces(mesh, parameters.boundaries, log);
    if (!parameters.regions.empty())
      select_cells(mesh, parameters.regions, log);
  }
} // namespace corotet
