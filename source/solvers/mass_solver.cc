// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/solvers/mass_solver.h>

#include <deal.II/lac/solver_cg.h>

#include <cmath>

namespace corotet
{
  MassSolver::MassSolver(const Discretization   &discretization,
                         const Mass             &mass,
                         const PrescribedMotion &motion)
    : mass(mass)
    , motion(motion)
  {
    discretization.initialize_vector(ghosted);
    Vector inverse(ghosted);
    for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
      inverse.local_element(i) =
        motion.is_prescribed()[i] ? 0. : 1 / mass.diagonal().local_element(i);
    inverse_diagonal.reinit(inverse);
  }

  void
  MassSolver::vmult(Vector &dst, const Vector &src) const
  {
    copy_with_ghosts(ghosted, src);
    mass.apply(dst, ghosted);
    motion.set_zero(dst);
  }

  unsigned int
  MassSolver::solve(Vector &a, const Vector &r) const
  {
    inverse_diagonal.vmult(a, r);
    if (mass.is_lumped())
      return 0;
    const double r_norm = norm(r);
    if (!std::isfinite(r_norm))
      return 0;
    // Round-off is the only limit.
    dealii::SolverControl    control(500, 1e-13 * r_norm);
    dealii::SolverCG<Vector> cg(control);
    try
      {
        cg.solve(*this, a, r, inverse_diagonal);
      }
    catch (const dealii::SolverControl::NoConvergence &)
      {
        throw ComputationError("the acceleration did not converge");
      }
    return control.last_step();
  }
} // namespace corotet
