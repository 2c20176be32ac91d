// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Finds cells of degree 2 and 3 that are straight up to round-off or the digits
// of a file.

#include <corotet/mesh/curved_cells.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "written_digits.h"

namespace corotet
{
  using dealii::Point;

  namespace
  {
    // The largest distance of a node from its straight position, in lengths of
    // the cell's longest edge: more than the round-off of coordinates in files,
    // less than matters to any discretization error.
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



    // The position of a point in the straight cell with these vertices.
    Point<3>
    straight_position(const Point<3> *vertices, const Point<3> &xi)
    {
      Point<3> x = vertices[0];
      for (unsigned int k = 0; k < 3; ++k)
        x += xi[k] * (vertices[k + 1] - vertices[0]);
      return x;
    }



    // Whether all nodes are near their straight positions: at most @p part of
    // the longest edge away and, in each direction, at most @p by.
    bool
    is_straight(const Point<3>              *nodes,
                const std::vector<Point<3>> &points,
                const double                 part,
                const dealii::Tensor<1, 3>  &by)
    {
      const double tolerance = part * longest_edge(nodes);
      for (unsigned int i = 4; i < points.size(); ++i)
        {
          const Point<3> x = straight_position(nodes, points[i]);
          if (!(x.distance(nodes[i]) <= tolerance))
            return false;
          for (unsigned int a = 0; a < 3; ++a)
            if (!(std::abs(x[a] - nodes[i][a]) <= by[a]))
              return false;
        }
      return true;
    }

    bool
    is_straight(const Point<3> *nodes, const std::vector<Point<3>> &points)
    {
      dealii::Tensor<1, 3> anything;
      for (unsigned int a = 0; a < 3; ++a)
        anything[a] = std::numeric_limits<double>::infinity();
      return is_straight(nodes, points, round_off, anything);
    }

    // Whether a cell is straight up to rounding to so many digits. If rounding
    // moves nodes by more than a fraction of an edge, the file is too coarse to
    // tell.
    bool
    is_straight(const Point<3>              *nodes,
                const std::vector<Point<3>> &points,
                const WrittenDigits         &digits)
    {
      constexpr double     most = 2e-3;
      dealii::Tensor<1, 3> by;
      for (unsigned int a = 0; a < 3; ++a)
        {
          double size = 0;
          for (unsigned int i = 0; i < points.size(); ++i)
            size = std::max(size, std::abs(nodes[i][a]));
          // The last term is the round-off of the comparison.
          by[a] = (1 + 1e-6) * digits.last_digit(size) + 1e-14 * size;
        }
      return is_straight(nodes, points, most, by);
    }

    std::string
    remark_on_straight_cells(const std::size_t n, const WrittenDigits &digits)
    {
      return n == 0 ? "" :
                      fmt::format("{} cells are straight but for the {} digits "
                                  "that the file has of coordinates: they are "
                                  "taken as straight",
                                  n,
                                  digits.n_significant());
    }

    template <typename IsStraight>
    unsigned int
    remove_maps(MeshCells                   &mesh,
                const std::vector<Point<3>> &points,
                const IsStraight            &is_straight)
    {
      unsigned int          n_removed = 0;
      std::vector<Point<3>> kept;
      for (MeshCells::Cell &cell : mesh.cells)
        if (cell.curve != MeshCells::straight)
          {
            const Point<3> *nodes = curved_nodes(mesh, cell);
            cell.curve            = MeshCells::straight;
            if (is_straight(nodes))
              {
                ++n_removed;
                continue;
              }
            cell.curve = kept.size() / points.size();
            kept.insert(kept.end(), nodes, nodes + points.size());
          }
      mesh.curved_nodes = std::move(kept);
      if (mesh.curved_nodes.empty())
        mesh.geometry_degree = 1;
      return n_removed;
    }
  } // namespace



  void
  remove_straight_maps(MeshCells &mesh)
  {
    if (mesh.geometry_degree == 1)
      return;
    const std::vector<Point<3>> points = map_points(mesh.geometry_degree);
    remove_maps(mesh, points, [&](const Point<3> *nodes) {
      return is_straight(nodes, points);
    });
  }

  std::string
  remove_written_straight_maps(MeshCells &mesh)
  {
    remove_straight_maps(mesh);
    if (mesh.curved_nodes.empty())
      return "";
    const WrittenDigits digits(mesh.curved_nodes);
    if (digits.n_significant() == 0)
      return "";
    const std::vector<Point<3>> points = map_points(mesh.geometry_degree);
    const unsigned int          n =
      remove_maps(mesh, points, [&](const Point<3> *nodes) {
        return is_straight(nodes, points, digits);
      });
    return remark_on_straight_cells(n, digits);
  }



  std::string
  straighten_written_cells(std::vector<Point<3>>            &nodes,
                           const std::vector<std::uint32_t> &cells,
                           const unsigned int                degree)
  {
    const WrittenDigits digits(nodes);
    if (digits.n_significant() == 0)
      return "";
    const std::vector<Point<3>> points = map_points(degree);
    std::vector<Point<3>>       of_cell(points.size());
    std::size_t                 n_moved = 0;
    for (std::size_t first = 0; first < cells.size(); first += points.size())
      {
        for (unsigned int i = 0; i < points.size(); ++i)
          of_cell[i] = nodes[cells[first + i]];
        if (is_straight(of_cell.data(), points) ||
            !is_straight(of_cell.data(), points, digits))
          continue;
        ++n_moved;
        for (unsigned int i = 4; i < points.size(); ++i)
          nodes[cells[first + i]] =
            straight_position(of_cell.data(), points[i]);
      }
    return remark_on_straight_cells(n_moved, digits);
  }
} // namespace corotet
