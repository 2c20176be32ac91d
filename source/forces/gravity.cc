// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/gravity.h>
#include <corotet/operators/mass.h>

namespace corotet
{
  using dealii::Tensor;

  Gravity::Gravity(const Discretization &discretization,
                   const Mass           &mass,
                   const Expression     &acceleration)
    : DeadLoad(discretization, acceleration)
    , mass(mass)
  {}

  void
  Gravity::integrate(Vector &f, const Field &acceleration) const
  {
    Vector a, force;
    discretization.initialize_vector(a);
    discretization.initialize_vector(force);
    for (unsigned int n = 0; n < discretization.n_local_nodes(); ++n)
      {
        const Tensor<1, 3> g =
          acceleration(discretization.node_position(n), {});
        for (unsigned int i = 0; i < 3; ++i)
          a.local_element(3 * n + i) = g[i];
      }
    mass.apply(force, a);
    for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
      f.local_element(i) += force.local_element(i);
  }

  GravityKind::GravityKind()
    : VectorFieldKind("Gravity", "Acceleration [m/s^2] of gravity")
  {}

  std::vector<ForceKind::GivenEntry>
  GravityKind::given() const
  {
    std::vector<GivenEntry> entries = VectorFieldKind::given();
    for (GivenEntry &entry : entries)
      entry.on_mass = true;
    return entries;
  }

  std::unique_ptr<ForceTerm>
  GravityKind::make(const Expression &value, const ForceContext &context) const
  {
    return std::make_unique<Gravity>(context.discretization,
                                     context.mass,
                                     value);
  }
} // namespace corotet
