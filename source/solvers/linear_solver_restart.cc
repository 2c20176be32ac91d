// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The data that LinearSolver keeps in checkpoints.

#include <corotet/solvers/linear_solver.h>

namespace corotet
{
  void
  LinearSolver::transfer(Archive &archive)
  {
    std::string saved = type();
    archive.transfer("type", saved);
    if (saved != type())
      // The run goes on with another preconditioner, which has no data to
      // restore.
      return;
    archive.transfer("is_built", is_built);
    archive.transfer("built_mass_ratio", built_mass_ratio);
    archive.transfer("built_surface", built_surface);
    archive.transfer("n_builds", n_builds);
    archive.transfer("first_iterations", first_iterations);
    archive.transfer("more_iterations", more_iterations);
    preconditioner->transfer(archive);
  }

  void
  LinearSolver::build_again(const EffectiveOperator &A,
                            const TangentOperator   *J,
                            const Vector            &displacement)
  {
    preconditioner->build_for(A, J, displacement);
    known_version = A.version();
    built_version = A.version();
  }
} // namespace corotet
