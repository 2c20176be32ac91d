// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/solvers/mass_solver.h>

#include <deal.II/base/mpi.h>
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

  unsigned int
  MassSolver::solve(Vector                        &a,
                    const Vector                  &r,
                    const double                   c_M,
                    const SurfaceOperator<double> &S) const
  {
    if (residual.size() == 0)
      for (Vector *vector : {&residual, &direction, &product, &inverse})
        vector->reinit(ghosted);
    const Vector &diagonal = mass.diagonal();
    const auto    for_each = [&](const auto &function) {
      if (!mass.is_lumped())
        for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
          function(i);
      else
        for (const unsigned int node : S.owned_nodes())
          for (unsigned int i = 3 * node; i < 3 * node + 3; ++i)
            function(i);
    };
    const auto sum_of = [&](const auto &value) {
      double sum = 0;
      for_each([&](const unsigned int i) { sum += value(i); });
      return dealii::Utilities::MPI::sum(sum, a.get_mpi_communicator());
    };
    const auto product_of = [&](const Vector &x, const Vector &y) {
      return sum_of([&](const unsigned int i) {
        return x.local_element(i) * y.local_element(i);
      });
    };

    // The diagonal everywhere, which is all there is where S does not act.
    inverse = 0;
    S.add_diagonal(inverse);
    for (unsigned int i = 0; i < a.locally_owned_size(); ++i)
      {
        double &d          = inverse.local_element(i);
        d                  = motion.is_prescribed()[i] ?
                               0. :
                               1 / (c_M * diagonal.local_element(i) + d);
        a.local_element(i) = d * r.local_element(i);
      }
    const double wanted = 1e-13 * std::sqrt(product_of(r, r));
    if (!std::isfinite(wanted) || wanted == 0)
      return 0;

    // Conjugate gradients from there. The first direction of all makes no use
    // of an earlier one.
    const auto multiply = [&](const Vector &x) {
      copy_with_ghosts(ghosted, x);
      if (mass.is_lumped())
        for_each([&](const unsigned int i) {
          product.local_element(i) =
            c_M * diagonal.local_element(i) * x.local_element(i);
        });
      else
        {
          mass.apply(product, ghosted);
          product *= c_M;
        }
      S.add(product, ghosted);
    };
    multiply(a);
    for_each([&](const unsigned int i) {
      const double free = inverse.local_element(i) > 0 ? 1. : 0.;
      residual.local_element(i) =
        free * (r.local_element(i) - product.local_element(i));
      direction.local_element(i) = 0;
    });
    constexpr unsigned int limit = 500;
    double                 rho   = 0;
    for (unsigned int n = 0; n < limit; ++n)
      {
        if (product_of(residual, residual) <= wanted * wanted)
          return n;
        const double last = rho;
        rho               = sum_of([&](const unsigned int i) {
          return residual.local_element(i) * residual.local_element(i) *
                 inverse.local_element(i);
        });
        const double beta = n == 0 ? 0. : rho / last;
        for_each([&](const unsigned int i) {
          direction.local_element(i) =
            beta * direction.local_element(i) +
            inverse.local_element(i) * residual.local_element(i);
        });
        multiply(direction);
        const double alpha = rho / product_of(direction, product);
        for_each([&](const unsigned int i) {
          a.local_element(i) += alpha * direction.local_element(i);
          if (inverse.local_element(i) > 0)
            residual.local_element(i) -= alpha * product.local_element(i);
        });
      }
    throw ComputationError("the acceleration did not converge");
  }
} // namespace corotet
