// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "tether.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <limits>

using corotet::Motion;
using corotet::Vector;
using dealii::Point;
using dealii::Tensor;

Tether::Tether(const corotet::Discretization &discretization,
               const Point<3>                &point,
               const Point<3>                &anchor,
               const double                   stiffness,
               const double                   length)
  : anchor(anchor)
  , stiffness(stiffness)
  , length(length)
{
  // Finds the node nearest to the point among the owned nodes of all ranks.
  double distance = std::numeric_limits<double>::infinity();
  for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
    if (discretization.node_position(n).distance(point) < distance)
      {
        node     = n;
        distance = discretization.node_position(n).distance(point);
      }
  if (discretization.n_owned_nodes() > 0)
    position = discretization.node_position(node);
  const auto nearest =
    dealii::Utilities::MPI::min_max_avg(distance,
                                        discretization.communicator());
  is_owned = dealii::Utilities::MPI::this_mpi_process(
               discretization.communicator()) == nearest.min_index;
}

Tensor<1, 3>
Tether::rope(const Vector &u) const
{
  Tensor<1, 3> rope = position - anchor;
  for (unsigned int a = 0; a < 3; ++a)
    rope[a] += u.local_element(3 * node + a);
  return rope;
}

void
Tether::add_force(Vector &f, const Motion &motion) const
{
  if (!is_owned)
    return;
  const Tensor<1, 3> d = rope(motion.u);
  const double       l = d.norm();
  if (l <= length)
    return;
  const Tensor<1, 3> force = -stiffness * (l - length) / l * d;
  for (unsigned int a = 0; a < 3; ++a)
    f.local_element(3 * node + a) += force[a];
}

void
Tether::linearize(const Motion &motion)
{
  derivative = 0;
  if (!is_owned)
    return;
  const Tensor<1, 3> d = rope(motion.u);
  const double       l = d.norm();
  if (l <= length)
    return;
  // The stiffness is k along the rope, and tension over length across it.
  const Tensor<2, 3> along    = outer_product(d, d) / (l * l);
  const Tensor<2, 3> identity = dealii::unit_symmetric_tensor<3>();
  derivative = -stiffness * (along + (l - length) / l * (identity - along));
}

void
Tether::add_linearized(Vector       &f,
                       const Vector &w,
                       const double /*velocity_factor*/) const
{
  if (!is_owned)
    return;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      f.local_element(3 * node + a) +=
        derivative[a][b] * w.local_element(3 * node + b);
}

void
TetherKind::declare_parameters(dealii::ParameterHandler &prm)
{
  using namespace dealii::Patterns;
  prm.enter_subsection("Tether");
  prm.add_parameter("Point",
                    point,
                    "Of the body at rest [m]: the rope is tied to the node "
                    "nearest to it.");
  prm.add_parameter("Anchor", anchor, "Where the rope's other end is [m].");
  prm.add_parameter("Stiffness",
                    stiffness,
                    "Force per elongation [N/m]; 0: there is no rope.",
                    Double(0));
  prm.add_parameter("Length",
                    length,
                    "Up to which it does not pull [m].",
                    Double(0));
  prm.leave_subsection();
}

std::vector<corotet::ForceKind::GivenEntry>
TetherKind::given() const
{
  if (stiffness == 0)
    return {};
  return {{"Tether/Stiffness", std::to_string(stiffness), "0"}};
}

void
TetherKind::add_to(corotet::ForceTerms         &terms,
                   const corotet::ForceContext &context) const
{
  if (stiffness > 0)
    terms.add(std::make_unique<Tether>(
      context.discretization, point, anchor, stiffness, length));
}
