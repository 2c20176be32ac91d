// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  PointGeometry
  point_geometry(const Discretization                &discretization,
                 const ReferenceElement::PointValues &rule,
                 const unsigned int                   cell,
                 const unsigned int                   q)
  {
    if (discretization.is_curved(cell))
      {
        const Tensor<2, 3> J = discretization.jacobian(cell, rule, q);
        return {invert(J), rule.weights[q] * determinant(J) / 6};
      }
    const CellGeometry &geometry = discretization.geometry(cell);
    return {geometry.inverse_jacobian, rule.weights[q] * geometry.volume};
  }

  Point<3>
  point_position(const Discretization                &discretization,
                 const ReferenceElement::PointValues &rule,
                 const unsigned int                   cell,
                 const unsigned int                   q)
  {
    const auto nodes = discretization.cell_nodes(cell);
    Point<3>   position;
    for (unsigned int i = 0; i < nodes.size(); ++i)
      position += rule.values(q, i) * discretization.node_position(nodes[i]);
    return position;
  }

  Tensor<2, 3>
  displacement_gradient(const Discretization                &discretization,
                        const Vector                        &u,
                        const unsigned int                   cell,
                        const ReferenceElement::PointValues &rule,
                        const unsigned int                   q)
  {
    const auto   nodes = discretization.cell_nodes(cell);
    Tensor<2, 3> by_xi;
    for (unsigned int i = 1; i < nodes.size(); ++i)
      for (unsigned int a = 0; a < 3; ++a)
        {
          const double difference = u.local_element(3 * nodes[i] + a) -
                                    u.local_element(3 * nodes[0] + a);
          for (unsigned int k = 0; k < 3; ++k)
            by_xi[a][k] += difference * rule.gradients(q, i, k);
        }
    return by_xi *
           point_geometry(discretization, rule, cell, q).inverse_jacobian;
  }
} // namespace corotet
