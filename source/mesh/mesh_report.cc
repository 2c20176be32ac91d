// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/disjoint_sets.h>
#include <corotet/base/exceptions.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/mesh_quality.h>
#include <corotet/mesh/mesh_report.h>

#include <deal.II/base/tensor.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    // The extent and size of a named part of the body or of its surface.
    struct NamedPart
    {
      std::size_t  n    = 0;
      double       size = 0;
      Point<3>     lower, upper;
      Tensor<1, 3> normals;

      void
      add(const Point<3> &x)
      {
        for (unsigned int d = 0; d < 3; ++d)
          {
            lower[d] = is_empty ? x[d] : std::min(lower[d], x[d]);
            upper[d] = is_empty ? x[d] : std::max(upper[d], x[d]);
          }
        is_empty = false;
      }

      void
      add(const NamedPart &other)
      {
        n += other.n;
        size += other.size;
        normals += other.normals;
        if (!other.is_empty)
          {
            add(other.lower);
            add(other.upper);
          }
      }

    private:
      bool is_empty = true;
    };



    // The shares of the values between the bounds, as bars.
    std::string
    histogram(const std::string              &title,
              const std::vector<double>      &values,
              const std::vector<double>      &bounds,
              const std::vector<std::string> &names)
    {
      std::vector<std::size_t> counts(names.size());
      for (const double value : values)
        ++counts[std::upper_bound(bounds.begin(), bounds.end(), value) -
                 bounds.begin()];
      std::string result = title + "\n";
      for (std::size_t i = 0; i < names.size(); ++i)
        if (counts[i] > 0)
          {
            const double share = static_cast<double>(counts[i]) / values.size();
            result += fmt::format("  {:>10} {:6.2f} %  {}\n",
                                  names[i],
                                  100 * share,
                                  std::string(std::ceil(40 * share), '#'));
          }
      return result;
    }



    std::string
    shapes(const SerialMesh &mesh)
    {
      std::vector<double> angles, ratios;
      for (const SerialMesh::Cell &cell : mesh.cells)
        {
          const CellShape shape = cell_shape(cell_vertices(mesh, cell));
          for (const double cosine : shape.dihedral_cosines)
            angles.push_back(std::acos(std::clamp(cosine, -1., 1.)) * 180 /
                             std::numbers::pi);
          ratios.push_back(shape.aspect_ratio);
        }
      return histogram("Dihedral angles [degrees] (70.53 in the regular "
                       "tetrahedron):",
                       angles,
                       {2, 10, 20, 30, 50, 80, 100, 130, 150, 160, 170, 178},
                       {"0-2",
                        "2-10",
                        "10-20",
                        "20-30",
                        "30-50",
                        "50-80",
                        "80-100",
                        "100-130",
                        "130-150",
                        "150-160",
                        "160-170",
                        "170-178",
                        "178-180"}) +
             histogram("Aspect ratios (1 for the regular tetrahedron):",
                       ratios,
                       {1.5, 2, 3, 5, 10, 30, 100},
                       {"1-1.5",
                        "1.5-2",
                        "2-3",
                        "3-5",
                        "5-10",
                        "10-30",
                        "30-100",
                        "over 100"});
    }



    // A table with one line for each name.
    std::string
    table(const std::string                       &title,
          const MeshNames                         &names,
          const std::map<unsigned int, NamedPart> &parts,
          const bool                               with_size,
          const bool                               with_normal)
    {
      std::string result = title + "\n";
      std::size_t width  = 4;
      const auto  known  = names.known_with_ids();
      for (const auto &[name, ids] : known)
        width = std::max(width, name.size());
      for (const auto &[name, ids] : known)
        {
          NamedPart part;
          for (const unsigned int id : ids)
            part.add(parts.at(id));
          result += fmt::format("  {:{}}  ", name, width);
          if (with_size)
            result += fmt::format("{:>12.6g} ", part.size);
          result += fmt::format("{:>8}  ({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, "
                                "{:.4g}, {:.4g})",
                                part.n,
                                part.lower[0],
                                part.lower[1],
                                part.lower[2],
                                part.upper[0],
                                part.upper[1],
                                part.upper[2]);
          // If a part is flat, the norm of the sum of its normals is its area.
          if (with_normal && part.normals.norm() > (1 - 1e-6) * part.size)
            {
              const Tensor<1, 3> n       = part.normals / part.normals.norm();
              const auto         rounded = [](const double x) {
                return std::round(1e4 * x) / 1e4 + 0.;
              };
              result += fmt::format(", flat, normal ({:g}, {:g}, {:g})",
                                    rounded(n[0]),
                                    rounded(n[1]),
                                    rounded(n[2]));
            }
          result += '\n';
        }
      return result;
    }



    std::string
    note_on_curves(const SerialMesh &mesh)
    {
      return mesh.geometry_degree > 1 ?
               " (of the straight cells with the same vertices)" :
               "";
    }



    std::string
    regions(const SerialMesh &mesh)
    {
      std::map<unsigned int, NamedPart> parts;
      std::vector<unsigned int>         ids;
      for (const SerialMesh::Cell &cell : mesh.cells)
        {
          NamedPart &part = parts[cell.region];
          ++part.n;
          part.size += signed_volume(cell_vertices(mesh, cell));
          for (const unsigned int v : cell.vertices)
            part.add(mesh.vertices[v]);
          ids.push_back(cell.region);
        }
      NamedSets named = mesh.regions;
      named.restrict_to(ids);
      return table("Regions: volume, cells, extent" + note_on_curves(mesh),
                   MeshNames("region", named),
                   parts,
                   true,
                   false);
    }



    std::string
    boundaries(const SerialMesh &mesh)
    {
      // A point inside of each face's cell, to make normals point outward.
      std::map<std::array<unsigned int, 3>, Point<3>> inner_points;
      const auto ascending = [](std::array<unsigned int, 3> face) {
        std::sort(face.begin(), face.end());
        return face;
      };
      for (const SerialMesh::Face &face : mesh.faces)
        inner_points[ascending(face.vertices)];
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (unsigned int k = 0; k < 4; ++k)
          {
            const auto &v     = cell.vertices;
            const auto  found = inner_points.find(
              ascending({{v[(k + 1) % 4], v[(k + 2) % 4], v[(k + 3) % 4]}}));
            if (found != inner_points.end())
              found->second = mesh.vertices[v[k]];
          }

      std::map<unsigned int, NamedPart> parts;
      std::vector<unsigned int>         ids;
      for (const SerialMesh::Face &face : mesh.faces)
        {
          NamedPart     &part   = parts[face.boundary];
          const auto    &x      = mesh.vertices;
          const Point<3> p0     = x[face.vertices[0]];
          Tensor<1, 3>   normal = cross_product_3d(x[face.vertices[1]] - p0,
                                                 x[face.vertices[2]] - p0) /
                                2.;
          if (normal * (inner_points.at(ascending(face.vertices)) - p0) > 0)
            normal *= -1;
          ++part.n;
          part.size += normal.norm();
          part.normals += normal;
          for (const unsigned int v : face.vertices)
            part.add(x[v]);
          ids.push_back(face.boundary);
        }
      NamedSets named = mesh.boundaries;
      named.restrict_to(ids);
      return ids.empty() ?
               "Boundaries: none\n" :
               table("Boundaries: area, faces, extent" + note_on_curves(mesh),
                     MeshNames("boundary", named),
                     parts,
                     true,
                     true);
    }



    // The table of the names of edges or of corners; empty without names.
    template <typename Part, typename Add>
    std::string
    parts_with_names(const std::string       &title,
                     const std::string       &kind,
                     NamedSets                named,
                     const std::vector<Part> &all,
                     const bool               with_size,
                     const Add               &add)
    {
      std::map<unsigned int, NamedPart> parts;
      std::vector<unsigned int>         ids;
      for (const Part &part : all)
        {
          ++parts[part.id].n;
          add(parts[part.id], part);
          ids.push_back(part.id);
        }
      named.restrict_to(ids);
      return ids.empty() ?
               "" :
               table(title, MeshNames(kind, named), parts, with_size, false);
    }



    std::string
    edges(const SerialMesh &mesh)
    {
      return parts_with_names(
        "Edges: length, edges of cells, extent" + note_on_curves(mesh),
        "edge",
        mesh.edge_names,
        mesh.edges,
        true,
        [&](NamedPart &part, const SerialMesh::Edge &edge) {
          const Point<3> &a = mesh.vertices[edge.vertices[0]];
          const Point<3> &b = mesh.vertices[edge.vertices[1]];
          part.size += a.distance(b);
          part.add(a);
          part.add(b);
        });
    }



    std::string
    corners(const SerialMesh &mesh)
    {
      return parts_with_names("Corners: vertices, extent",
                              "corner",
                              mesh.corner_names,
                              mesh.corners,
                              false,
                              [&](NamedPart                &part,
                                  const SerialMesh::Corner &corner) {
                                part.add(mesh.vertices[corner.vertex]);
                              });
    }


    // The number of bodies that have no vertex in common.
    unsigned int
    number_of_bodies(const SerialMesh &mesh)
    {
      DisjointSets      sets(mesh.vertices.size());
      std::vector<bool> is_used(mesh.vertices.size());
      unsigned int      n = 0;
      for (const SerialMesh::Cell &cell : mesh.cells)
        for (const unsigned int v : cell.vertices)
          {
            n += !is_used[v];
            is_used[v] = true;
            n -= sets.root(v) != sets.root(cell.vertices[0]);
            sets.unite(cell.vertices[0], v);
          }
      return n;
    }
  } // namespace



  std::string
  mesh_report(const SerialMesh &mesh)
  {
    const MeshQuality quality = mesh_quality(mesh);
    std::string result = fmt::format("{} cells, {} vertices, volume {:.6g}\n",
                                     mesh.cells.size(),
                                     mesh.vertices.size(),
                                     quality.volume);
    if (mesh.geometry_degree > 1)
      result +=
        fmt::format("Curved cells of degree {}: {}\n",
                    mesh.geometry_degree,
                    std::count_if(mesh.cells.begin(),
                                  mesh.cells.end(),
                                  [](const SerialMesh::Cell &cell) {
                                    return cell.curve != SerialMesh::straight;
                                  }));
    if (const unsigned int n = number_of_bodies(mesh); n > 1)
      result += fmt::format(
        "{} bodies without a common node, and each moves on its own\n", n);
    for (const std::string &remark : mesh.remarks)
      result += remark + '\n';
    return result + shapes(mesh) + regions(mesh) + boundaries(mesh) +
           edges(mesh) + corners(mesh);
  }
} // namespace corotet
