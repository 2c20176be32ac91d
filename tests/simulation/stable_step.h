// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_stable_step_h
#define corotet_tests_simulation_stable_step_h

#include <string>

#include "../body.h"

namespace corotet::tests
{
  /// The stable step of central differences for a body at rest, without
  /// damping [s].
  inline double
  stable_step(const std::string &text)
  {
    BodyInput        input(text, MPI_COMM_WORLD);
    corotet::Body    body(input.parameters, "", MPI_COMM_WORLD, input.log);
    StructuralSystem system(body,
                            input.parameters,
                            input.wall_times,
                            input.log);
    State            state;
    system.initialize(state);
    return 2 / system.acceleration_solver().largest_frequencies(state).all;
  }
} // namespace corotet::tests

#endif
