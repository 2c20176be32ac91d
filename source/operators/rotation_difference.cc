// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/point_geometry.h>
#include <corotet/material/corotational.h>
#include <corotet/material/polar_decomposition.h>
#include <corotet/operators/rotation_difference.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <optional>

namespace corotet
{
  using dealii::Tensor;

  namespace
  {
    // The rotation of the deformation gradient at point @p q of @p rule.
    Tensor<2, 3>
    rotation(const Discretization                &discretization,
             const Vector                        &u,
             const unsigned int                   cell,
             const ReferenceElement::PointValues &rule,
             const unsigned int                   q,
             const Tensor<2, 3>                  &inverse_jacobian)
    {
      const auto   nodes = discretization.cell_nodes(cell);
      Tensor<2, 3> gradient;
      for (unsigned int i = 0; i < nodes.size(); ++i)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int k = 0; k < 3; ++k)
            gradient[a][k] +=
              u.local_element(3 * nodes[i] + a) * rule.gradients[q][i][k];
      Tensor<2, 3> F = gradient * inverse_jacobian;
      for (unsigned int a = 0; a < 3; ++a)
        F[a][a] += 1;
      return polar_decomposition(F).rotation;
    }
  } // namespace

  double
  largest_rotation_difference(const Discretization   &discretization,
                              const ReferenceElement &reference,
                              const Vector           &u)
  {
    std::optional<ReferenceElement::PointValues> curved_rule;
    double                                       angle = 0;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const bool is_curved = discretization.is_curved(c);
        if (is_curved && !curved_rule)
          curved_rule = ReferenceElement::curved_rule(discretization.element());
        const auto &rule = is_curved ? *curved_rule : reference.stiffness_rule;
        const Tensor<2, 3> centre =
          rotation(discretization,
                   u,
                   c,
                   reference.centre,
                   0,
                   discretization.geometry(c).inverse_jacobian);
        for (unsigned int q = 0; q < rule.weights.size(); ++q)
          angle = std::max(angle,
                           rotation_angle(
                             transpose(centre) *
                             rotation(discretization,
                                      u,
                                      c,
                                      rule,
                                      q,
                                      point_geometry(discretization, rule, c, q)
                                        .inverse_jacobian)));
      }
    return dealii::Utilities::MPI::max(angle, discretization.communicator());
  }
} // namespace corotet
