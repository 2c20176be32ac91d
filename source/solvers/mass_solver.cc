// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/ghosted_copy.h>
#include <corotet/base/negligible.h>
#include <corotet/solvers/mass_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>

#include <cmath>
#include <utility>

namespace corotet
{
  MassSolver::MassSolver(const Discretization   &discretization,
                         const Mass             &mass,
                         const PrescribedMotion &motion)
    : mass(mass)
    , motion(motion)
  {
    discretization.initialize_vector(ghosted);
    Vector        inverse(ghosted);
    const Vector &diagonal = mass.diagonal();
    for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
      inverse.local_element(i) =
        motion.is_prescribed()[i] ? 0. : 1 / diagonal.local_element(i);
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
    if (!std::isfinite(r_norm) || r_norm <= negligible)
      return 0;
    // Only round-off limits the accuracy.
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

  template <typename Function>
  void
  MassSolver::for_each_coupled(const SurfaceOperator<double> &S,
                               const Function                &function) const
  {
    if (!mass.is_lumped())
      for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
        function(i);
    else
      for (const unsigned int node : S.owned_nodes())
        for (unsigned int i = 3 * node; i < 3 * node + 3; ++i)
          function(i);
  }

  void
  MassSolver::multiply(const Vector                  &x,
                       const double                   c_M,
                       const SurfaceOperator<double> &S) const
  {
    if (mass.is_lumped())
      {
        for_each_coupled(S, [&](const unsigned int i) {
          ghosted.local_element(i) = x.local_element(i);
          product.local_element(i) =
            c_M * mass.diagonal().local_element(i) * x.local_element(i);
        });
        ghosted.update_ghost_values();
      }
    else
      {
        copy_with_ghosts(ghosted, x);
        mass.apply(product, ghosted);
        product *= c_M;
      }
    S.add(product, ghosted);
    for_each_coupled(S, [&](const unsigned int i) {
      if (inverse.local_element(i) == 0)
        product.local_element(i) = 0;
    });
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
    const auto for_each = [&](const auto &function) {
      for_each_coupled(S, function);
    };
    const auto sum_of_products = [&](const Vector &x, const Vector &y) {
      double sum = 0;
      for_each([&](const unsigned int i) {
        sum += x.local_element(i) * y.local_element(i);
      });
      return dealii::Utilities::MPI::sum(sum, a.get_mpi_communicator());
    };

    // The start is a division by the diagonal, which is the whole matrix where
    // S does not act.
    for_each([&](const unsigned int i) { inverse.local_element(i) = 0; });
    S.add_diagonal(inverse);
    for_each([&](const unsigned int i) {
      double &d          = inverse.local_element(i);
      d                  = motion.is_prescribed()[i] ?
                             0. :
                             1 / (c_M * mass.diagonal().local_element(i) + d);
      a.local_element(i) = d * r.local_element(i);
    });
    const double size = std::sqrt(sum_of_products(r, r));
    if (!std::isfinite(size) || size <= negligible)
      return 0;
    const double wanted = 1e-13 * size;

    // Conjugate gradients go on from that start.
    multiply(a, c_M, S);
    for_each([&](const unsigned int i) {
      residual.local_element(i) = r.local_element(i) - product.local_element(i);
      direction.local_element(i) = 0;
    });
    constexpr unsigned int limit = 500;
    double                 rho   = 1;
    for (unsigned int n = 0; n < limit; ++n)
      {
        if (std::sqrt(sum_of_products(residual, residual)) <= wanted)
          return n;
        // The vector product has the preconditioned residual for a moment.
        for_each([&](const unsigned int i) {
          product.local_element(i) =
            inverse.local_element(i) * residual.local_element(i);
        });
        const double last =
          std::exchange(rho, sum_of_products(residual, product));
        const double beta = n == 0 ? 0. : rho / last;
        for_each([&](const unsigned int i) {
          direction.local_element(i) =
            beta * direction.local_element(i) + product.local_element(i);
        });
        multiply(direction, c_M, S);
        const double alpha = rho / sum_of_products(direction, product);
        for_each([&](const unsigned int i) {
          a.local_element(i) += alpha * direction.local_element(i);
          residual.local_element(i) -= alpha * product.local_element(i);
        });
      }
    throw ComputationError("the acceleration did not converge");
  }
} // namespace corotet
