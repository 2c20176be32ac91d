// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {



    // All points whose barycentric coordinates are multiples of 1 / n.
    std::vector<Point<3>>
    lattice(const unsigned int n)
    {
      std::vector<Point<3>> points;
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; i + j <= n; ++j)
          for (unsigned int k = 0; i + j + k <= n; ++k)
            points.emplace_back(double(i) / n, double(j) / n, double(k) / n);
      return points;
    }



    // The mean determinant of the Jacobian, which is 1 if the volume is 1/6.
    double
    mean_determinant(const MapAtPoints         &map,
                     const std::vector<double> &weights,
                     const Point<3>            *nodes)
    {
      double sum = 0;
      for (unsigned int q = 0; q < map.n_points(); ++q)
        sum += 6 * weights[q] * determinant(map.jacobian(nodes, q));
      return sum;
    }



    // A rule of degree 7: determinants are polynomials of degree 3 (q - 1) <=
    // 6.
    dealii::Quadrature<3>
    determinant_rule()
    {
      return dealii::QWitherdenVincentSimplex<3>(4);
    }



    // The result of checking the maps, interpolated with one degree.
    struct Folds
    {
      std::size_t            n_cells = 0;
      double                 worst   = std::numeric_limits<double>::infinity();
      unsigned int           worst_point = 0;
      const MeshCells::Cell *worst_cell  = nullptr;
    };



    // Finds the smallest determinants of the maps, interpolated with @p degree.
    Folds
    find_folds(const MeshCells &mesh, const unsigned int degree)
    {
      const auto            rule = determinant_rule();
      const MapAtPoints     on_lattice(degree, lattice(6));
      const MapAtPoints     in_rule(degree, rule.get_points());
      const MapAtPoints     full(mesh.geometry_degree, map_points(degree));
      std::vector<Point<3>> nodes(full.n_points());
      Folds                 folds;
      for (const MeshCells::Cell &cell : mesh.cells)
        if (cell.curve != MeshCells::straight)
          {
            for (unsigned int i = 0; i < nodes.size(); ++i)
              nodes[i] = full.position(curved_nodes(mesh, cell), i);
            const double mean = std::abs(
              mean_determinant(in_rule, rule.get_weights(), nodes.data()));
            bool folded = false;
            for (unsigned int q = 0; q < on_lattice.n_points(); ++q)
              {
                const double ratio =
                  determinant(on_lattice.jacobian(nodes.data(), q)) / mean;
                folded = folded || !(ratio > 0);
                if (folds.worst_cell == nullptr || !(ratio >= folds.worst))
                  {
                    folds.worst       = ratio;
                    folds.worst_cell  = &cell;
                    folds.worst_point = q;
                  }
              }
            if (folded)
              ++folds.n_cells;
          }
      return folds;
    }
  } // namespace



  namespace
  {
    template <unsigned int p>
    const dealii::FiniteElement<3> &
    element_of_degree()
    {
      static const dealii::FE_SimplexP<3> element(p);
      return element;
    }
  } // namespace



  const dealii::FiniteElement<3> &
  map_element(const unsigned int degree)
  {
    AssertThrow(degree >= 1 && degree <= 3, dealii::ExcInternalError());
    if (degree == 1)
      return element_of_degree<1>();
    return degree == 2 ? element_of_degree<2>() : element_of_degree<3>();
  }



  MapAtPoints::MapAtPoints(const unsigned int           degree,
                           const std::vector<Point<3>> &points)
  {
    const dealii::FiniteElement<3> &fe = map_element(degree);
    values.reinit(points.size(), fe.dofs_per_cell);
    gradients.reinit(points.size(), fe.dofs_per_cell);
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int i = 0; i < fe.dofs_per_cell; ++i)
        {
          values[q][i]    = fe.shape_value(i, points[q]);
          gradients[q][i] = fe.shape_grad(i, points[q]);
        }
  }



  std::vector<Point<3>>
  map_points(const unsigned int degree)
  {
    return map_element(degree).get_unit_support_points();
  }



  const Point<3> *
  curved_nodes(const MeshCells &mesh, const MeshCells::Cell &cell)
  {
    return &mesh.curved_nodes[std::size_t(mesh.n_map_nodes()) * cell.curve];
  }



  double
  check_curved_cells(const MeshCells   &mesh,
                     const std::string &origin,
                     const unsigned int element_degree,
                     const MPI_Comm     comm)
  {
    namespace MPI = dealii::Utilities::MPI;
    double worst  = std::numeric_limits<double>::infinity();
    for (unsigned int degree = std::min(mesh.geometry_degree, element_degree);
         degree > 1;
         --degree)
      {
        const Folds       folds    = find_folds(mesh, degree);
        const std::size_t n_folded = MPI::sum(folds.n_cells, comm);
        const double      lowest   = MPI::min(folds.worst, comm);
        worst                      = std::min(worst, lowest);
        if (n_folded == 0)
          continue;
        const std::size_t n_curved =
          MPI::sum(mesh.curved_nodes.size() / mesh.n_map_nodes(), comm);
        on_all_ranks(comm, [&] {
          if (folds.worst_cell == nullptr || folds.worst > lowest)
            return;
          refuse_mesh(
            origin,
            fmt::format(
              "{} of {} curved cells {} folded: found a Jacobian determinant of "
              "{:.3g} times its mean at {}; it must be positive everywhere, so "
              "make the mesh finer there, let gmsh optimise its high-order "
              "nodes, or take straight cells, by Geometry degree = 1 where "
              "gmsh makes the mesh of a shape or by Discretization/Degree = "
              "1{}",
              n_folded,
              n_curved,
              n_folded == 1 ? "is" : "are",
              folds.worst,
              position(MapAtPoints(mesh.geometry_degree, lattice(6))
                         .position(curved_nodes(mesh, *folds.worst_cell),
                                   folds.worst_point)),
              n_folded > 1 && 2 * n_folded > n_curved ?
                " (so many are folded where a file has the nodes of cells in "
                "another order than its format's)" :
                ""));
        });
      }
    return worst;
  }



  double
  volume_by_curvature(const MeshCells &mesh)
  {
    if (mesh.geometry_degree == 1)
      return 0;
    const auto        rule = determinant_rule();
    const MapAtPoints map(mesh.geometry_degree, rule.get_points());
    double            sum = 0;
    for (const MeshCells::Cell &cell : mesh.cells)
      if (cell.curve != MeshCells::straight)
        sum +=
          mean_determinant(map, rule.get_weights(), curved_nodes(mesh, cell)) /
            6 -
          signed_volume(cell_vertices(mesh, cell));
    return sum;
  }
} // namespace corotet
