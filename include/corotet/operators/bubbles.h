// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_bubbles_h
#define corotet_operators_bubbles_h

#include <corotet/discretization/tetrahedron.h>

#include <array>
#include <utility>

/**
 * The quadratic tetrahedron with bubbles, as compile-time tables. Its 15 nodes
 * are the vertices, the middles of edges, the centres of faces and that of the
 * cell, in the order of FE_SimplexP_Bubbles(2).
 */
namespace corotet::bubbles
{
  inline constexpr int n_nodes = 15;

  /// Means of the shape functions. They are the weights of the quadrature at
  /// the nodes, which is exact for all functions of the element, and so for
  /// degree 3.
  inline constexpr auto node_weights = [] {
    std::array<double, n_nodes> result{};
    for (int i = 0; i < n_nodes; ++i)
      {
        if (i < 4)
          result[i] = 17. / 840;
        else if (i < 10)
          result[i] = 4. / 105;
        else if (i < 14)
          result[i] = 27. / 280;
        else
          result[i] = 32. / 105;
      }
    return result;
  }();

  /// A quadrature point in barycentric coordinates; its weight is a fraction of
  /// the cell.
  struct Point
  {
    std::array<double, 4> lambda;
    double                weight;
  };

  inline constexpr int n_points = 14;

  /**
   * The rule of degree 5 for the stiffness (Walkington 2000), as chosen by
   * Geevers, Mulder, van der Vegt 2019, @cite geevers2019. Full order requires
   * exactness for linear functions times gradients of shape functions, which
   * are cubic: degree 4.
   */
  constexpr std::array<Point, n_points>
  make_stiffness_rule()
  {
    std::array<Point, n_points> rule{};
    int                         q = 0;
    // Points near the faces and near the vertices; then those near the edges.
    for (const auto &[distance, weight] :
         {std::pair(0.31088591926330060980, 0.11268792571801585080),
          std::pair(0.092735250310891226402, 0.073493043116361949544)})
      for (int v = 0; v < 4; ++v, ++q)
        {
          rule[q].lambda.fill(distance);
          rule[q].lambda[v] = 1 - 3 * distance;
          rule[q].weight    = weight;
        }
    for (const auto &[a, b] : tetrahedron::edges)
      {
        const double distance = 0.045503704125649649492;
        rule[q].lambda.fill(distance);
        rule[q].lambda[a] = rule[q].lambda[b] = 0.5 - distance;
        rule[q++].weight                      = 0.042546020777081466438;
      }
    return rule;
  }

  inline constexpr std::array<Point, n_points> stiffness_rule =
    make_stiffness_rule();

  /// [node][k - 1]: derivative of N_i by lambda_k - lambda_0.
  using Derivatives = std::array<std::array<double, 3>, n_nodes>;

  /// The derivatives at a point. The shape functions are quadratic Lagrange
  /// polynomials and the bubbles 27 lambda_a lambda_b lambda_c and 256 lambda_0
  /// lambda_1 lambda_2 lambda_3, each minus its values at the nodes of the
  /// functions that follow.
  constexpr Derivatives
  derivatives(const std::array<double, 4> &lambda)
  {
    constexpr const auto &edges  = tetrahedron::edges;
    constexpr const auto &faces  = tetrahedron::faces;
    const auto            one_if = [](const bool is) { return is ? 1. : 0.; };
    // The derivatives by the four lambda as if they were independent.
    double d[n_nodes][4] = {};
    for (int k = 0; k < 4; ++k)
      {
        double &cell = d[14][k];
        cell         = 256;
        for (int v = 0; v < 4; ++v)
          cell *= v == k ? 1 : lambda[v];
        for (int v = 0; v < 4; ++v)
          d[v][k] = (v == k ? 4 * lambda[v] - 1 : 0.) + cell / 8;
        for (int e = 0; e < 6; ++e)
          {
            const auto [a, b] = edges[e];
            d[4 + e][k] =
              4 * (one_if(a == k) * lambda[b] + one_if(b == k) * lambda[a]) -
              cell / 4;
          }
        for (int f = 0; f < 4; ++f)
          {
            const int a = faces[f][0], b = faces[f][1], c = faces[f][2];
            double   &face = d[10 + f][k];
            face           = 27 * (one_if(a == k) * lambda[b] * lambda[c] +
                         one_if(b == k) * lambda[c] * lambda[a] +
                         one_if(c == k) * lambda[a] * lambda[b]) -
                   27. / 64 * cell;
            const auto is_on_face = [&](const int v) {
              return v == a || v == b || v == c;
            };
            for (int v = 0; v < 4; ++v)
              d[v][k] += is_on_face(v) ? face / 9 : 0;
            for (int e = 0; e < 6; ++e)
              d[4 + e][k] -=
                is_on_face(edges[e][0]) && is_on_face(edges[e][1]) ?
                  4 * face / 9 :
                  0;
          }
      }
    Derivatives result{};
    for (int i = 0; i < n_nodes; ++i)
      for (int k = 0; k < 3; ++k)
        result[i][k] = d[i][k + 1] - d[i][0];
    return result;
  }

  inline constexpr Derivatives centre_derivatives =
    derivatives({{0.25, 0.25, 0.25, 0.25}});

  /// The derivatives at the points of the rule.
  inline constexpr auto point_derivatives = [] {
    std::array<Derivatives, n_points> result{};
    for (int q = 0; q < n_points; ++q)
      result[q] = derivatives(stiffness_rule[q].lambda);
    return result;
  }();

  /// Means, by the rules, of squares of shape functions and of products of
  /// their derivatives, in the form of bernstein::DiagonalProducts.
  struct DiagonalProducts
  {
    std::array<double, n_nodes>                mass = node_weights;
    std::array<std::array<double, 6>, n_nodes> gradient{};
  };

  inline constexpr DiagonalProducts diagonal_products = [] {
    DiagonalProducts result;
    constexpr int    pairs[6][2] = {
      {0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
    for (int q = 0; q < n_points; ++q)
      for (int i = 0; i < n_nodes; ++i)
        for (int s = 0; s < 6; ++s)
          {
            const auto &d = point_derivatives[q][i];
            result.gradient[i][s] += (s < 3 ? 1 : 2) *
                                     stiffness_rule[q].weight * d[pairs[s][0]] *
                                     d[pairs[s][1]];
          }
    return result;
  }();
} // namespace corotet::bubbles

#endif
