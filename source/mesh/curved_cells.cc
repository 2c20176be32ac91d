// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // How far a node may lie off the straight position, in lengths of the
    // cell's longest edge: more than the round-off of coordinates in files,
    // less than matters to any error of discretization.
    constexpr double round_off = 1e-10;



    double
    longest_edge(const Point<3> *vertices)
    {
      double length = 0;
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < i; ++j)
          length = std::max(length, vertices[i].distance(vertices[j]));
      return length;
    }



    bool
    is_straight(const Point<3> *nodes, const std::vector<Point<3>> &points)
    {
      const double tolerance = round_off * longest_edge(nodes);
      for (unsigned int i = 4; i < points.size(); ++i)
        {
          Point<3> x = nodes[0];
          for (unsigned int k = 0; k < 3; ++k)
            x += points[i][k] * (nodes[k + 1] - nodes[0]);
          if (x.distance(nodes[i]) > tolerance)
            return false;
        }
      return true;
    }



    // All points with barycentric coordinates of multiples of 1 / n.
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



    // Of a tetrahedron with the volume 1/6, the mean determinant of Jacobians.
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



    // Of degree 7: determinants are polynomials of degree 3 (q - 1) <= 6.
    dealii::Quadrature<3>
    determinant_rule()
    {
      return dealii::QWitherdenVincentSimplex<3>(4);
    }



    // What the checks of the maps of one degree have found.
    struct Folds
    {
      std::size_t             n_cells = 0;
      double                  worst   = std::numeric_limits<double>::infinity();
      unsigned int            worst_point = 0;
      const SerialMesh::Cell *worst_cell  = nullptr;
    };



    // Smallest determinants of the maps, interpolated with @p degree.
    Folds
    find_folds(const SerialMesh &mesh, const unsigned int degree)
    {
      const auto            rule = determinant_rule();
      const MapAtPoints     on_lattice(degree, lattice(6));
      const MapAtPoints     in_rule(degree, rule.get_points());
      const MapAtPoints     full(mesh.geometry_degree, map_points(degree));
      std::vector<Point<3>> nodes(full.n_points());
      Folds                 folds;
      for (const SerialMesh::Cell &cell : mesh.cells)
        if (cell.curve != SerialMesh::straight)
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
  curved_nodes(const SerialMesh &mesh, const SerialMesh::Cell &cell)
  {
    const std::size_t q = mesh.geometry_degree;
    return &mesh.curved_nodes[(q + 1) * (q + 2) * (q + 3) / 6 * cell.curve];
  }



  void
  remove_straight_maps(SerialMesh &mesh)
  {
    if (mesh.geometry_degree == 1)
      return;
    const std::vector<Point<3>> points = map_points(mesh.geometry_degree);
    std::vector<Point<3>>       kept;
    for (SerialMesh::Cell &cell : mesh.cells)
      if (cell.curve != SerialMesh::straight)
        {
          const Point<3> *nodes = curved_nodes(mesh, cell);
          cell.curve            = SerialMesh::straight;
          if (is_straight(nodes, points))
            continue;
          cell.curve = kept.size() / points.size();
          kept.insert(kept.end(), nodes, nodes + points.size());
        }
    mesh.curved_nodes = std::move(kept);
    if (mesh.curved_nodes.empty())
      mesh.geometry_degree = 1;
  }



  double
  check_curved_cells(const SerialMesh &mesh, const unsigned int element_degree)
  {
    double worst = std::numeric_limits<double>::infinity();
    for (unsigned int degree = std::min(mesh.geometry_degree, element_degree);
         degree > 1;
         --degree)
      {
        const Folds folds = find_folds(mesh, degree);
        if (folds.n_cells > 0)
          refuse_mesh(
            mesh,
            fmt::format(
              "{} of {} curved cells {} folded: found a Jacobian determinant "
              "of {:.3g} times its mean at {}; it must be positive everywhere, "
              "so make the mesh finer there, let gmsh optimise its "
              "high-order nodes, or take Discretization/Degree = 1, whose "
              "cells are straight",
              folds.n_cells,
              mesh.curved_nodes.size() /
                map_points(mesh.geometry_degree).size(),
              folds.n_cells == 1 ? "is" : "are",
              folds.worst,
              position(MapAtPoints(mesh.geometry_degree, lattice(6))
                         .position(curved_nodes(mesh, *folds.worst_cell),
                                   folds.worst_point))));
        worst = std::min(worst, folds.worst);
      }
    return worst;
  }



  double
  volume_by_curvature(const SerialMesh &mesh)
  {
    if (mesh.geometry_degree == 1)
      return 0;
    const auto        rule = determinant_rule();
    const MapAtPoints map(mesh.geometry_degree, rule.get_points());
    double            sum = 0;
    for (const SerialMesh::Cell &cell : mesh.cells)
      if (cell.curve != SerialMesh::straight)
        sum +=
          mean_determinant(map, rule.get_weights(), curved_nodes(mesh, cell)) /
            6 -
          signed_volume(cell_vertices(mesh, cell));
    return sum;
  }



  void
  inherit_curves(const SerialMesh               &coarse,
                 const dealii::Triangulation<3> &tria,
                 SerialMesh                     &refined)
  {
    const unsigned int          q      = coarse.geometry_degree;
    const std::vector<Point<3>> points = map_points(q);
    refined.geometry_degree            = q;
    unsigned int n_cells               = 0;
    // Parts of the same shape and place are many.
    std::map<std::array<double, 12>, MapAtPoints> maps;
    for (const auto &active : tria.active_cell_iterators())
      {
        SerialMesh::Cell                       &cell = refined.cells[n_cells++];
        dealii::Triangulation<3>::cell_iterator top(active);
        while (top->level() > 0)
          top = top->parent();
        const SerialMesh::Cell &parent = coarse.cells[top->index()];
        if (parent.curve == SerialMesh::straight)
          continue;

        // The vertices in the reference coordinates of that cell: multiples of
        // a power of two.
        const double unit = std::pow(0.5, tria.n_levels() - 1);
        Tensor<2, 3> J;
        const auto   corners = cell_vertices(coarse, parent);
        Point<3>     vertices[4];
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int a = 0; a < 3; ++a)
            J[a][k] = corners[k + 1][a] - corners[0][a];
        for (unsigned int v = 0; v < 4; ++v)
          {
            const Tensor<1, 3> xi =
              invert(J) * (active->vertex(v) - corners[0]);
            for (unsigned int k = 0; k < 3; ++k)
              vertices[v][k] = unit * std::round(xi[k] / unit);
          }
        std::vector<Point<3>> places(points.size(), vertices[0]);
        for (unsigned int i = 0; i < points.size(); ++i)
          for (unsigned int k = 0; k < 3; ++k)
            places[i] += points[i][k] * (vertices[k + 1] - vertices[0]);

        std::array<double, 12> key;
        for (unsigned int i = 0; i < 12; ++i)
          key[i] = vertices[i / 3][i % 3];
        const MapAtPoints &map = maps.try_emplace(key, q, places).first->second;
        cell.curve             = refined.curved_nodes.size() / points.size();
        for (unsigned int i = 0; i < points.size(); ++i)
          refined.curved_nodes.push_back(
            map.position(curved_nodes(coarse, parent), i));
        for (unsigned int v = 0; v < 4; ++v)
          refined.vertices[cell.vertices[v]] =
            *(refined.curved_nodes.end() - points.size() + v);
      }
    remove_straight_maps(refined);
  }
} // namespace corotet
