// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corotet
{
  namespace
  {
    // Half the cross products of the edges, pointing outward. Face i is
    // opposite to vertex i.
    std::array<dealii::Tensor<1, 3>, 4>
    area_vectors(const std::array<dealii::Point<3>, 4> &p)
    {
      const auto area =
        [&](const unsigned int a, const unsigned int b, const unsigned int c) {
          return dealii::cross_product_3d(p[b] - p[a], p[c] - p[a]) / 2;
        };
      return {{area(1, 2, 3), area(0, 3, 2), area(0, 1, 3), area(0, 2, 1)}};
    }
  } // namespace



  double
  signed_volume(const std::array<dealii::Point<3>, 4> &p)
  {
    return dealii::cross_product_3d(p[1] - p[0], p[2] - p[0]) * (p[3] - p[0]) /
           6;
  }



  std::array<dealii::Point<3>, 4>
  cell_vertices(const SerialMesh &mesh, const SerialMesh::Cell &cell)
  {
    std::array<dealii::Point<3>, 4> p;
    for (unsigned int v = 0; v < 4; ++v)
      p[v] = mesh.vertices[cell.vertices[v]];
    return p;
  }



  CellShape
  cell_shape(const std::array<dealii::Point<3>, 4> &p)
  {
    const auto   areas   = area_vectors(p);
    CellShape    shape   = {signed_volume(p), {}, 0};
    double       surface = 0, longest_edge = 0;
    unsigned int n = 0;
    for (unsigned int i = 0; i < 4; ++i)
      {
        surface += areas[i].norm();
        for (unsigned int j = 0; j < i; ++j)
          {
            longest_edge = std::max(longest_edge, p[i].distance(p[j]));
            shape.dihedral_cosines[n++] =
              -(areas[i] * areas[j]) / (areas[i].norm() * areas[j].norm());
          }
      }
    const double inradius = 3 * shape.volume / surface;
    shape.aspect_ratio    = longest_edge / (2 * std::sqrt(6.) * inradius);
    return shape;
  }



  MeshQuality
  mesh_quality(const SerialMesh &mesh)
  {
    MeshQuality quality;
    double      largest_cosine = -1;
    for (const SerialMesh::Cell &cell : mesh.cells)
      {
        const CellShape shape = cell_shape(cell_vertices(mesh, cell));
        quality.volume += shape.volume;
        for (const double cosine : shape.dihedral_cosines)
          largest_cosine = std::max(largest_cosine, cosine);
        quality.worst_aspect_ratio =
          std::max(quality.worst_aspect_ratio, shape.aspect_ratio);
      }
    quality.volume += volume_by_curvature(mesh);
    quality.smallest_dihedral_angle =
      std::acos(std::min(largest_cosine, 1.)) * 180 / std::numbers::pi;
    return quality;
  }
} // namespace corotet
