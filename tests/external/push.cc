// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "push.h"

Push::Push(const corotet::ForceContext &context, const double *value)
  : value(value)
{
  // The integrals f_i of N_i, by the rule for loads.
  const corotet::Discretization &discretization = context.discretization;
  const auto                    &rule           = context.reference.load_rule;
  discretization.initialize_vector(unit_force);
  for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
    {
      const auto   nodes  = discretization.cell_nodes(c);
      const double volume = discretization.geometry(c).volume;
      for (unsigned int q = 0; q < rule.weights.size(); ++q)
        for (unsigned int i = 0; i < nodes.size(); ++i)
          unit_force.local_element(3 * nodes[i]) +=
            volume * rule.weights[q] * rule.values[q][i];
    }
  unit_force.compress(dealii::VectorOperation::add);
}

void
Push::add_force(corotet::Vector &f, const corotet::Motion &) const
{
  for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
    f.local_element(i) += *value * unit_force.local_element(i);
}
