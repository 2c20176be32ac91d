// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_solved_beam_h
#define corotet_tests_solvers_solved_beam_h

#include <string>
#include <vector>

#include "../body.h"

namespace corotet::tests
{
  /// The iterations, and the owned entries of the solution, for a clamped beam.
  struct Solved
  {
    unsigned int        iterations = 0;
    std::vector<double> x;
  };

  /// @p entries of the section Linear solver.
  inline Solved
  solve_beam(const std::string &cells,
             const unsigned int degree,
             const Entries      entries)
  {
    MovingBody        body(box("4, 1, 1", cells, 0.1),
                    element_text(degree) + fixed("x-min") +
                      section("Linear solver", entries));
    EffectiveOperator A(body.discretization,
                        body.elasticity,
                        body.mass,
                        body.motion.is_prescribed());
    A.update(1., 0.);
    Vector x(body.state.u), b(x);
    b = 1.;
    body.motion.set_zero(b);
    Solved result;
    result.iterations = LinearSolver(body.parameters.linear_solver)
                          .solve(A, x, b, body.discretization.node_positions());
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      result.x.push_back(x.local_element(i));
    return result;
  }
} // namespace corotet::tests

#endif
