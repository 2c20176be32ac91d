// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace corotet
{
  namespace
  {
    // The area vectors of the faces, pointing outward. Face i is opposite to
    // vertex i.
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



  double
  square_of_longest_edge(const std::array<dealii::Point<3>, 4> &p)
  {
    double square = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < i; ++j)
        square = std::max(square, (p[i] - p[j]).norm_square());
    return square;
  }



  std::array<dealii::Point<3>, 4>
  cell_vertices(const MeshCells &mesh, const MeshCells::Cell &cell)
  {
    std::array<dealii::Point<3>, 4> p;
    for (unsigned int v = 0; v < 4; ++v)
      p[v] = mesh.vertices[cell.vertices[v]];
    return p;
  }



  CellShape
  cell_shape(const std::array<dealii::Point<3>, 4> &p)
  {
    const auto            areas = area_vectors(p);
    CellShape             shape = {signed_volume(p), {}, 0};
    std::array<double, 4> one_over_area;
    double                surface = 0;
    for (unsigned int i = 0; i < 4; ++i)
      {
        const double area = std::sqrt(areas[i].norm_square());
        surface += area;
        one_over_area[i] = 1 / area;
      }
    unsigned int n = 0;
    for (unsigned int i = 0; i < 4; ++i)
      for (unsigned int j = 0; j < i; ++j)
        shape.dihedral_cosines[n++] =
          -(areas[i] * areas[j]) * one_over_area[i] * one_over_area[j];
    const double inradius = 3 * shape.volume / surface;
    shape.aspect_ratio = std::sqrt(square_of_longest_edge(p) / 24) / inradius;
    return shape;
  }



  MeshQuality
  mesh_quality(const MeshCells &mesh, const MPI_Comm comm)
  {
    double volume = 0, largest_cosine = -1, worst_aspect_ratio = 1;
    for (const MeshCells::Cell &cell : mesh.cells)
      {
        const CellShape shape = cell_shape(cell_vertices(mesh, cell));
        volume += shape.volume;
        for (const double cosine : shape.dihedral_cosines)
          largest_cosine = std::max(largest_cosine, cosine);
        worst_aspect_ratio = std::max(worst_aspect_ratio, shape.aspect_ratio);
      }
    namespace MPI = dealii::Utilities::MPI;
    MeshQuality quality;
    quality.volume = MPI::sum(volume + volume_by_curvature(mesh), comm);
    quality.worst_aspect_ratio = MPI::max(worst_aspect_ratio, comm);
    quality.smallest_dihedral_angle =
      std::acos(std::min(MPI::max(largest_cosine, comm), 1.)) * 180 /
      std::numbers::pi;
    return quality;
  }
} // namespace corotet
