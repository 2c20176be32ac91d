// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/nearby_cells.h>
#include <corotet/discretization/point_search.h>
#include <corotet/mesh/curved_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // The number of cells or nodes in a piece.
    constexpr unsigned int piece_length = 64;

    // Calls the action for the numbers of a piece, of @p n numbers in all.
    template <typename Action>
    void
    for_each_in_piece(const unsigned int piece,
                      const unsigned int n,
                      const Action      &action)
    {
      const unsigned int end = std::min(n, (piece + 1) * piece_length);
      for (unsigned int i = piece * piece_length; i < end; ++i)
        action(i);
    }
  } // namespace

  NearbyCells::Box::Box()
  {
    for (unsigned int a = 0; a < 3; ++a)
      {
        lower[a] = std::numeric_limits<double>::infinity();
        upper[a] = -lower[a];
      }
  }

  void
  NearbyCells::Box::include(const Point<3> &x)
  {
    for (unsigned int a = 0; a < 3; ++a)
      {
        lower[a] = std::min(lower[a], x[a]);
        upper[a] = std::max(upper[a], x[a]);
      }
  }

  void
  NearbyCells::Box::include(const Box &other)
  {
    include(other.lower);
    include(other.upper);
  }

  void
  NearbyCells::Box::widen(const Tensor<1, 3> &by)
  {
    lower -= by;
    upper += by;
  }

  double
  NearbyCells::Box::distance_square(const Point<3> &x) const
  {
    double sum = 0;
    for (unsigned int a = 0; a < 3; ++a)
      {
        const double d = std::max({lower[a] - x[a], x[a] - upper[a], 0.});
        sum += d * d;
      }
    return sum;
  }

  NearbyCells::NearbyCells(const Discretization &discretization)
    : discretization(discretization)
    , map_nodes(map_points(discretization.degree()))
  {
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        if (c % piece_length == 0)
          cell_pieces.emplace_back();
        const Box  box   = box_of_cell(c);
        auto      &piece = cell_pieces.back();
        const auto sides = box.upper - box.lower;
        for (unsigned int a = 0; a < 3; ++a)
          piece.sides[a] = std::max(piece.sides[a], sides[a]);
        piece.box.include(box);
      }
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        if (n % piece_length == 0)
          node_pieces.emplace_back();
        node_pieces.back().include(discretization.node_position(n));
      }
  }

  NearbyCells::Box
  NearbyCells::box_of_cell(const unsigned int cell) const
  {
    const auto         nodes  = discretization.cell_nodes(cell);
    const Point<3>    &origin = discretization.node_position(nodes[0]);
    const Tensor<2, 3> G      = discretization.geometry(cell).inverse_jacobian;
    Box                box;
    box.include(origin);
    double       longest = 0;
    Tensor<2, 3> edges;
    for (unsigned int k = 0; k < 3; ++k)
      {
        const Point<3> &vertex = discretization.node_position(nodes[k + 1]);
        edges[k]               = vertex - origin;
        longest                = std::max(longest, edges[k].norm());
        box.include(vertex);
      }
    // PointSearch allows barycentric coordinates down to -epsilon. Then the
    // point is outside of the box by at most the sum of these parts of its
    // sides.
    double part =
      PointSearch::tolerance * 2 * longest *
      (G[0].norm() + G[1].norm() + G[2].norm() + (G[0] + G[1] + G[2]).norm());
    if (discretization.is_curved(cell))
      {
        // A curved cell's Jacobian changes from point to point.
        part += 1e-3;
        Tensor<1, 3> deviation;
        for (unsigned int i = 4; i < map_nodes.size(); ++i)
          {
            const Tensor<1, 3> difference =
              discretization.node_position(nodes[i]) - origin -
              Tensor<1, 3>(map_nodes[i]) * edges;
            for (unsigned int a = 0; a < 3; ++a)
              deviation[a] = std::max(deviation[a], std::abs(difference[a]));
          }
        box.widen(PointSearch::growth * deviation);
        const Tensor<2, 3> J = transpose(invert(G));
        for (unsigned int k = 0; k < 3; ++k)
          box.include(origin + J[k]);
      }
    box.widen(part * (box.upper - box.lower));
    return box;
  }

  std::vector<unsigned int>
  NearbyCells::cells(const Point<3> &x, const double outside) const
  {
    std::vector<unsigned int> found;
    for (unsigned int piece = 0; piece < cell_pieces.size(); ++piece)
      {
        Box box = cell_pieces[piece].box;
        // Each of the four coordinates may be outside by as much.
        box.widen(4 * outside * cell_pieces[piece].sides);
        if (box.distance_square(x) == 0)
          for_each_in_piece(piece,
                            discretization.n_owned_cells(),
                            [&](const unsigned int c) { found.push_back(c); });
      }
    return found;
  }

  double
  NearbyCells::distance_to_nodes(const Point<3> &x) const
  {
    double     least = std::numeric_limits<double>::infinity();
    const auto look  = [&](const unsigned int n) {
      least =
        std::min(least, x.distance_square(discretization.node_position(n)));
    };
    const unsigned int n_nodes = discretization.n_owned_nodes();
    // The nearest box comes first: then most others are too far away.
    std::vector<double> distances;
    for (const Box &box : node_pieces)
      distances.push_back(box.distance_square(x));
    if (!distances.empty())
      for_each_in_piece(std::min_element(distances.begin(), distances.end()) -
                          distances.begin(),
                        n_nodes,
                        look);
    for (unsigned int piece = 0; piece < distances.size(); ++piece)
      if (distances[piece] < least)
        for_each_in_piece(piece, n_nodes, look);
    return std::sqrt(least);
  }

  std::vector<unsigned int>
  NearbyCells::nodes(const Point<3> &x, const double distance) const
  {
    std::vector<unsigned int> found;
    for (unsigned int piece = 0; piece < node_pieces.size(); ++piece)
      if (std::sqrt(node_pieces[piece].distance_square(x)) <= distance)
        for_each_in_piece(
          piece, discretization.n_owned_nodes(), [&](const unsigned int n) {
            if (discretization.node_position(n).distance(x) <= distance)
              found.push_back(n);
          });
    return found;
  }
} // namespace corotet
