// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_clamped_body_h
#define corotet_tests_solvers_clamped_body_h

#include <deal.II/lac/solver_cg.h>

#include <string>

#include "../body.h"

namespace corotet::tests
{
  /// A box that is clamped where x is smallest, its stiffness A, and a load b
  /// with the value one along z at each node.
  struct ClampedBody
  {
    /// @p entries of a parameter file.
    ClampedBody(const std::string &size,
                const std::string &cells,
                const std::string &entries)
      : body(box(size, cells), fixed("x-min") + entries)
      , A(body.discretization,
          body.elasticity,
          body.mass,
          body.motion.is_prescribed())
      , b(body.state.u)
    {
      A.update(1., 0.);
      for (unsigned int i = 2; i < b.locally_owned_size(); i += 3)
        b.local_element(i) = 1;
      body.motion.set_zero(b);
    }

    const Vector &
    displacement() const
    {
      return body.state.u;
    }

    const Vector &
    positions() const
    {
      return body.discretization.node_positions();
    }

    MovingBody        body;
    EffectiveOperator A;
    Vector            b;
  };

  /// The number of iterations of conjugate gradients until the residual is 1e-8
  /// of the load.
  template <typename Inverse>
  unsigned int
  iterations(const ClampedBody &body, const Inverse &inverse)
  {
    Vector                   x(body.b);
    dealii::SolverControl    control(2000, 1e-8 * body.b.l2_norm());
    dealii::SolverCG<Vector> cg(control);
    x = 0;
    cg.solve(body.A, x, body.b, inverse);
    return control.last_step();
  }
} // namespace corotet::tests

#endif
