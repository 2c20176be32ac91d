// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_search.h>
#include <corotet/discretization/tetrahedron.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // The map of a part is almost affine if its nodes deviate by less, in
    // barycentric coordinates: then its Jacobian changes by less than half in
    // the part, and Newton's method converges from the middle.
    constexpr double almost_affine = 0.05;

    // The limit of subdivisions: at this level even sagittas of 100 times the
    // thickness are almost affine. More is needed only where a Jacobian is
    // almost singular.
    constexpr unsigned int max_level = 14;

    // The corners of the eight children of a tetrahedron, four at its vertices
    // and four around a diagonal between the middles of its edges: the number
    // of a vertex, or 4 + the number of an edge.
    constexpr unsigned int children_corners[8][4] = {{0, 4, 6, 7},
                                                     {1, 4, 5, 8},
                                                     {2, 5, 6, 9},
                                                     {3, 7, 8, 9},
                                                     {4, 9, 5, 6},
                                                     {4, 9, 5, 8},
                                                     {4, 9, 7, 8},
                                                     {4, 9, 6, 7}};

    std::array<Point<3>, 4>
    child_corners(const std::array<Point<3>, 4> &corners,
                  const unsigned int             number)
    {
      std::array<Point<3>, 4> result;
      for (unsigned int v = 0; v < 4; ++v)
        if (const unsigned int c = children_corners[number][v]; c < 4)
          result[v] = corners[c];
        else
          {
            const auto &edge = tetrahedron::edges[c - 4];
            result[v] =
              corners[edge[0]] + 0.5 * (corners[edge[1]] - corners[edge[0]]);
          }
      return result;
    }

    std::array<Point<3>, 4>
    reference_corners()
    {
      std::array<Point<3>, 4> corners;
      for (unsigned int k = 0; k < 3; ++k)
        corners[k + 1][k] = 1;
      return corners;
    }

    // The point of the tetrahedron with these corners at coordinates @p xi.
    Point<3>
    place(const std::array<Point<3>, 4> &corners, const Point<3> &xi)
    {
      Point<3> p = corners[0];
      for (unsigned int k = 0; k < 3; ++k)
        p += xi[k] * (corners[k + 1] - corners[0]);
      return p;
    }

    std::vector<Point<3>>
    children_points(const std::vector<Point<3>> &points)
    {
      std::vector<Point<3>> result;
      for (unsigned int c = 0; c < 8; ++c)
        for (const Point<3> &xi : points)
          result.push_back(place(child_corners(reference_corners(), c), xi));
      return result;
    }

    // The inverse Jacobian d xi / dx of a tetrahedron's map [1/m]; not a number
    // if it is flat.
    Tensor<2, 3>
    inverse_jacobian(const std::vector<Point<3>> &vertices)
    {
      Tensor<2, 3> J;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int a = 0; a < 3; ++a)
          J[a][k] = vertices[k + 1][a] - vertices[0][a];
      return invert(J);
    }

    // The gradients of the barycentric coordinates.
    std::array<Tensor<1, 3>, 4>
    gradients(const Tensor<2, 3> &inverse_jacobian)
    {
      std::array<Tensor<1, 3>, 4> d;
      for (unsigned int k = 0; k < 3; ++k)
        {
          d[k + 1] = inverse_jacobian[k];
          d[0] -= inverse_jacobian[k];
        }
      return d;
    }

    // The normal of the largest face, its longest edge, and a vector normal to
    // both: the axes of a box around a thin tetrahedron [m^2, m, m^3].
    std::array<Tensor<1, 3>, 3>
    axes(const std::vector<Point<3>> &vertices)
    {
      Tensor<1, 3> normal, edge;
      for (const auto &face : tetrahedron::faces)
        {
          const Tensor<1, 3> n =
            cross_product_3d(vertices[face[1]] - vertices[face[0]],
                             vertices[face[2]] - vertices[face[0]]);
          if (n.norm_square() < normal.norm_square())
            continue;
          normal = n;
          edge   = {};
          for (unsigned int i = 0; i < 3; ++i)
            {
              const Tensor<1, 3> e =
                vertices[face[(i + 1) % 3]] - vertices[face[i]];
              if (e.norm_square() > edge.norm_square())
                edge = e;
            }
        }
      return {{normal, edge, cross_product_3d(normal, edge)}};
    }

    double
    longest_edge(const std::array<Point<3>, 4> &vertices)
    {
      double length = 0;
      for (const auto &edge : tetrahedron::edges)
        length =
          std::max(length, vertices[edge[0]].distance(vertices[edge[1]]));
      return length;
    }

    // Whether the point at @p xi is beyond each face by at most @p distance.
    bool
    is_inside(const Point<3>     &xi,
              const Tensor<2, 3> &inverse_jacobian,
              const double        distance)
    {
      const auto d = gradients(inverse_jacobian);
      for (unsigned int k = 0; k < 4; ++k)
        {
          const double lambda = k == 0 ? 1 - xi[0] - xi[1] - xi[2] : xi[k - 1];
          if (!(lambda >= -distance * d[k].norm()))
            return false;
        }
      return true;
    }
  } // namespace

  PointSearch::PointSearch(const Discretization &discretization)
    : discretization(&discretization)
    , points(map_points(discretization.degree()))
    , children(discretization.degree(), children_points(points))
  {}

  std::optional<Point<3>>
  PointSearch::find(const unsigned int cell, const Point<3> &x) const
  {
    const auto              nodes = discretization->cell_nodes(cell);
    std::array<Point<3>, 4> vertices;
    for (unsigned int v = 0; v < 4; ++v)
      vertices[v] = discretization->node_position(nodes[v]);
    const double longest  = longest_edge(vertices);
    const double distance = tolerance * longest;
    if (!discretization->is_curved(cell))
      {
        // Excludes most cells: none of their points is farther from a vertex
        // than the longest edge, up to the allowed distance.
        if (x.distance_square(vertices[0]) > 4 * longest * longest)
          return {};
        const Tensor<2, 3> G = discretization->geometry(cell).inverse_jacobian;
        const Point<3>     xi(G * (x - vertices[0]));
        if (!is_inside(xi, G, distance))
          return {};
        return xi;
      }
    Part whole{0, reference_corners(), {}};
    // The nodes of the map are the first ones; an element with bubbles has more
    // nodes.
    for (unsigned int i = 0; i < points.size(); ++i)
      whole.nodes.emplace_back(discretization->node_position(nodes[i]) - x);
    return find_in_part({cell, x, distance}, whole);
  }

  std::optional<Point<3>>
  PointSearch::find_in_part(const Target &target, const Part &part) const
  {
    for (const Tensor<1, 3> &d : axes(part.nodes))
      if (!bounds(target, part, d).may_contain)
        return {};
    bool is_affine = true;
    for (const Tensor<1, 3> &d : gradients(inverse_jacobian(part.nodes)))
      {
        const Bounds b = bounds(target, part, d);
        if (!b.may_contain)
          return {};
        is_affine = is_affine && b.deviation < almost_affine;
      }
    if (is_affine || part.level == max_level)
      return find_from(target, place(part.corners, {0.25, 0.25, 0.25}));
    for (unsigned int c = 0; c < 8; ++c)
      if (const auto xi = find_in_part(target, child(part, c)))
        return xi;
    return {};
  }

  std::optional<Point<3>>
  PointSearch::find_from(const Target &target, const Point<3> &start) const
  {
    const auto &fe    = discretization->finite_element().base_element(0);
    const auto  nodes = discretization->cell_nodes(target.cell);
    Point<3>    xi    = start;
    // Quadratic convergence from the size of a part to round-off takes some 6
    // iterations.
    for (unsigned int k = 0; k < 20; ++k)
      {
        Tensor<1, 3> difference;
        Tensor<2, 3> J;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            const Tensor<1, 3> X =
              discretization->node_position(nodes[i]) - target.x;
            difference -= fe.shape_value(i, xi) * X;
            J += outer_product(X, fe.shape_grad(i, xi));
          }
        const Tensor<2, 3> G    = invert(J);
        const Tensor<1, 3> step = G * difference;
        // The map has no meaning several cells away.
        if (!(step.norm() < 10))
          return {};
        xi += step;
        // The remaining error is of the order of the square of the step.
        if (step.norm() < 1e-9)
          {
            if (is_inside(xi, G, target.distance))
              return xi;
            return {};
          }
      }
    return {};
  }

  PointSearch::Bounds
  PointSearch::bounds(const Target       &target,
                      const Part         &part,
                      const Tensor<1, 3> &direction) const
  {
    std::array<double, 4> corners;
    for (unsigned int v = 0; v < 4; ++v)
      corners[v] = direction * part.nodes[v];
    double deviation = 0;
    for (unsigned int i = 4; i < points.size(); ++i)
      {
        double f = direction * part.nodes[i] - corners[0];
        for (unsigned int k = 0; k < 3; ++k)
          f -= points[i][k] * (corners[k + 1] - corners[0]);
        // This comparison keeps a value that is not a number.
        if (!(std::abs(f) <= deviation))
          deviation = std::abs(f);
      }
    const auto [least, most] =
      std::minmax_element(corners.begin(), corners.end());
    // The slack of a thousandth is far above the round-off of the bounds.
    const double slack = growth * deviation + 1e-3 * (*most - *least) +
                         target.distance * direction.norm();
    return {!(*least > slack) && !(*most < -slack), deviation};
  }

  PointSearch::Part
  PointSearch::child(const Part &part, const unsigned int number) const
  {
    Part result{part.level + 1, child_corners(part.corners, number), {}};
    for (unsigned int i = 0; i < points.size(); ++i)
      result.nodes.push_back(
        children.position(part.nodes.data(), number * points.size() + i));
    return result;
  }
} // namespace corotet
