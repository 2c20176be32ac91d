// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The program corotet with an additional law of elasticity, force and time
// integrator.

#include <corotet/base/selectable.h>
#include <corotet/laws/law_kind.h>
#include <corotet/studies/program.h>

#include "bathe.h"
#include "quadratic_volume.h"
#include "tether.h"

int
main(int argc, char **argv)
{
  const corotet::AddedCandidate<corotet::LawKind> quadratic_volume(
    corotet::law_candidate("quadratic volume", [] {
      return corotet::material_law(std::make_shared<QuadraticVolume>());
    }));
  const corotet::AddedCandidate<corotet::ForceKind> tether(
    corotet::candidate<corotet::ForceKind, TetherKind>("tether"));
  const corotet::AddedCandidate<corotet::TimeIntegrator> bathe(
    corotet::candidate<corotet::TimeIntegrator, Bathe>("Bathe"));

  return corotet::run_program(argc, argv);
}
