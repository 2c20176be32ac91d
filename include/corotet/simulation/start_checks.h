// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_start_checks_h
#define corotet_simulation_start_checks_h

#include <corotet/base/log.h>
#include <corotet/discretization/rigid_motions.h>
#include <corotet/simulation/structural_system.h>

#include <vector>

namespace corotet
{
  /**
   * Throws InputError if a run cannot begin with the state @p initial: if the
   * initial displacement contradicts a support or turns cells inside out, or if
   * a load is not finite at the start or at the end. (In statics the initial
   * displacement is a guess, which supports need not agree with.) Warns of
   * supports that jump. Collective.
   */
  void
  check_start(StructuralSystem           &system,
              const SimulationParameters &parameters,
              const State                &initial,
              Log                        &log);

  /**
   * Warns of what is allowed, and seldom meant: materials that are almost
   * incompressible. Collective.
   */
  void
  warn_of_body(const Body &body, Log &log);

  /**
   * Warns of forces that cannot act: of loads and supports whose force is on
   * nodes alone that other supports hold or move, and of damping in statics;
   * and of forces of programs whose derivatives are wrong. Collective.
   */
  void
  warn_of_forces(EquationOfMotion           &equation,
                 const SimulationParameters &parameters,
                 Log                        &log);

  /**
   * Warns of motions that @p springs hardly resist because of their directions:
   * springs normal to a curved surface leave the body free to slide along it,
   * but for the shape of the cells' faces. Collective.
   */
  void
  warn_of_weak_springs(const Body                              &body,
                       const std::vector<RigidMotions::Spring> &springs,
                       Log                                     &log);
} // namespace corotet

#endif
