// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/body_force.h>

#include <algorithm>
#include <vector>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  BodyForce::BodyForce(const Discretization   &discretization,
                       const ReferenceElement &reference,
                       const Expression       &value)
    : DeadLoad(discretization, value)
    , reference(reference)
  {}

  BodyForce::BodyForce(const Discretization   &discretization,
                       const ReferenceElement &reference,
                       const Value            &value,
                       const bool              depends_on_time)
    : DeadLoad(discretization, value, depends_on_time)
    , reference(reference)
  {}

  void
  BodyForce::integrate(Vector &f, const Field &force) const
  {
    const auto &rule = reference.load_rule;
    // The nodal forces of one cell.
    std::vector<Tensor<1, 3>> nodal_forces(reference.n_nodes);
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const CellGeometry &geometry  = discretization.geometry(c);
        const bool          is_curved = discretization.is_curved(c);
        const auto          nodes     = discretization.cell_nodes(c);
        const Point<3>      origin    = discretization.node_position(nodes[0]);
        const Tensor<2, 3>  J         = invert(geometry.inverse_jacobian);
        std::fill(nodal_forces.begin(), nodal_forces.end(), Tensor<1, 3>());
        for (unsigned int q = 0; q < rule.weights.size(); ++q)
          {
            Point<3> x      = origin + J * rule.points[q];
            double   volume = geometry.volume;
            if (is_curved)
              {
                x = Point<3>();
                for (unsigned int i = 0; i < reference.n_nodes; ++i)
                  x +=
                    rule.values[q][i] * discretization.node_position(nodes[i]);
                volume = determinant(discretization.jacobian(c, rule, q)) / 6;
              }
            const Tensor<1, 3>  b = force(x, {}) * (rule.weights[q] * volume);
            const double *const values = &rule.values(q, 0);
            for (unsigned int i = 0; i < reference.n_nodes; ++i)
              nodal_forces[i] += values[i] * b;
          }
        for (unsigned int i = 0; i < reference.n_nodes; ++i)
          for (unsigned int a = 0; a < 3; ++a)
            f.local_element(3 * nodes[i] + a) += nodal_forces[i][a];
      }
  }

  BodyForceKind::BodyForceKind()
    : VectorFieldKind("Body force", "Force per volume at rest [N/m^3]")
  {}

  std::unique_ptr<ForceTerm>
  BodyForceKind::make(const Expression   &value,
                      const ForceContext &context) const
  {
    return std::make_unique<BodyForce>(context.discretization,
                                       context.reference,
                                       value);
  }
} // namespace corotet
