// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const Point<3> middle(0.25, 0.25, 0.25);

    // Newton's method for coordinates in a curved cell.
    Point<3>
    in_curved_cell(const Discretization &discretization,
                   const unsigned int    cell,
                   const Point<3>       &x,
                   const Point<3>       &start)
    {
      const Point<3> outside(-1, -1, -1);
      const auto    &fe    = discretization.finite_element().base_element(0);
      const auto     nodes = discretization.cell_nodes(cell);
      Point<3>       xi    = start;
      // Quadratic convergence from a cell's size to round-off takes some 6.
      for (unsigned int k = 0; k < 20; ++k)
        {
          Tensor<1, 3> difference = x;
          Tensor<2, 3> J;
          for (unsigned int i = 0; i < nodes.size(); ++i)
            {
              const Point<3> X = discretization.node_position(nodes[i]);
              difference -= fe.shape_value(i, xi) * X;
              J += outer_product(X, fe.shape_grad(i, xi));
            }
          const Tensor<1, 3> step = invert(J) * difference;
          // Several cells away the map means nothing.
          if (!(step.norm() < 10))
            return outside;
          xi += step;
          if (step.norm() < 1e-12)
            return xi;
        }
      return outside;
    }
  } // namespace

  PointGeometry
  point_geometry(const Discretization                &discretization,
                 const ReferenceElement::PointValues &rule,
                 const unsigned int                   cell,
                 const unsigned int                   q)
  {
    const auto nodes = discretization.cell_nodes(cell);
    Point<3>   position;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      position += rule.values(q, i) * discretization.node_position(nodes[i]);
    if (discretization.is_curved(cell))
      {
        const Tensor<2, 3> J = discretization.jacobian(cell, rule, q);
        return {invert(J), rule.weights[q] * determinant(J) / 6, position};
      }
    const CellGeometry &geometry = discretization.geometry(cell);
    return {geometry.inverse_jacobian,
            rule.weights[q] * geometry.volume,
            position};
  }

  Point<3>
  reference_coordinates(const Discretization &discretization,
                        const unsigned int    cell,
                        const Point<3>       &x)
  {
    const auto          nodes = discretization.cell_nodes(cell);
    const Tensor<2, 3> &G     = discretization.geometry(cell).inverse_jacobian;
    // The first node is vertex 0, the origin of the reference cell.
    if (!discretization.is_curved(cell))
      return Point<3>(G * (x - discretization.node_position(nodes[0])));

    const auto &fe = discretization.finite_element().base_element(0);
    Point<3>    centre;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      centre +=
        fe.shape_value(i, middle) * discretization.node_position(nodes[i]);
    const Point<3> xi = middle + G * (x - centre);
    // Curved cells are within few of their lengths of the affine one.
    return xi.distance(middle) < 3 ?
             in_curved_cell(discretization, cell, x, xi) :
             xi;
  }
} // namespace corotet
