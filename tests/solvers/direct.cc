// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Direct solvers are inverses up to round-off times the condition number; that
// of CHOLMOD, which every build has, agrees with the one called 'direct'.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/direct.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../body.h"
#include "preconditioner_names.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  std::unique_ptr<Preconditioner>
  registered(const std::string &name)
  {
    for (const auto &candidate : preconditioners())
      if (candidate.name == name)
        return candidate.make();
    return nullptr;
  }
} // namespace

// The inverse is right also after the matrix has changed, and with a new
// solver. The condition number of the beam is below 1e6, that with inertia far
// below.
TEST(Direct, InvertsMatrix)
{
  MovingBody        body(box("4, 1, 1", "4, 1, 1", 0.1),
                  element_text(2) + fixed("x-min"));
  EffectiveOperator A(body.discretization,
                      body.elasticity,
                      body.mass,
                      body.motion.is_prescribed());
  const auto        other = registered("direct");
  CholeskyDirect    direct;
  Vector            x(body.state.u), b(x), found(x), other_found(x);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    x.local_element(i) = std::cos(
      0.1 * static_cast<double>(x.get_partitioner()->local_to_global(i)));
  for (const double mass : {0., 1e6})
    {
      A.update(1., mass);
      A.vmult(b, x);
      CholeskyDirect afresh;
      for (CholeskyDirect *solver : {&direct, &afresh})
        {
          solver->build(A, body.discretization.node_positions());
          solver->vmult(found, b);
          EXPECT_LE(largest_difference(found, x), 1e-10);
        }
      other->build(A, body.discretization.node_positions());
      other->vmult(other_found, b);
      EXPECT_LE(largest_difference(other_found, x), 1e-10);
    }
}

// A body that can move without resistance has a singular matrix.
TEST(Direct, RefusesFreeBody)
{
  MovingBody        body(box("4, 1, 1", "4, 1, 1", 0.1), element_text(2));
  EffectiveOperator A(body.discretization,
                      body.elasticity,
                      body.mass,
                      body.motion.is_prescribed());
  A.update(1., 0.);
  CholeskyDirect direct;
  EXPECT_THROW(direct.build(A, body.discretization.node_positions()),
               ComputationError);
}
