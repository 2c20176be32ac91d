// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Section Linear solver, and which of its methods fit which operators.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/preconditioners.h>

#include <fmt/format.h>

namespace corotet
{
  namespace
  {
    const Enumeration<KrylovMethod> methods{
      {"automatic", KrylovMethod::automatic},
      {"conjugate gradients", KrylovMethod::conjugate_gradients},
      {"minres", KrylovMethod::minres},
      {"gmres", KrylovMethod::gmres}};

    const Enumeration<bool> operators{{"matrix-free", false},
                                      {"assembled", true}};
  } // namespace

  LinearSolverParameters::LinearSolverParameters()
    : preconditioner(preconditioners(), "automatic")
  {}

  void
  LinearSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    preconditioner.declare_parameters(
      prm,
      "Preconditioner: 'automatic', p-multigrid, or a sparse factorisation "
      "where that is the faster way, as on thin bodies of few cells across; "
      "'p-multigrid', over the degrees down to 1, matrix-free; 'amg', smoothed "
      "aggregation with rigid body modes, on the assembled matrix (where "
      "Trilinos has ML); 'jacobi', the diagonal; 'direct', a sparse "
      "factorisation of the assembled matrix.");
    add_enumeration(prm,
                    "Method",
                    method,
                    methods,
                    "Krylov method. 'automatic': conjugate gradients for "
                    "symmetric systems, MINRES where these turn out to be "
                    "indefinite; for those that are not symmetric flexible "
                    "conjugate gradients, and where these are slow GMRES "
                    "(flexible, restarted after 30 iterations, up to 200 "
                    "where its vectors take less than 64 MiB), whose "
                    "vectors take nearly as much memory as all the rest.");
    add_enumeration(prm,
                    "Operator",
                    is_assembled,
                    operators,
                    "How the matrix is applied: cell by cell without "
                    "storing it, or assembled.");
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Residual at which iterations stop, relative to the "
                      "right hand side [-]. Iterations of Newton's method "
                      "that are not the last one, as the step before tells, "
                      "and will leave more of it anyway get by with less.",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "A solve that needs more has failed [-]. With an exact "
                      "tangent 1,000 are enough to fail (with factors of a "
                      "matrix, 100 or as many as take as long): then the "
                      "frozen one is asked.",
                      dealii::Patterns::Integer(1));
  }

  void
  LinearSolver::check_fit(const bool symmetric) const
  {
    if (parameters.is_assembled)
      throw InputError("Linear solver/Operator",
                       "found assembled; allowed: matrix-free, as this "
                       "material's tangent is not assembled (an assembled "
                       "one needs Material/Rotation = cell centre and "
                       "Newton/Tangent = frozen rotation)");
    const KrylovMethod method = parameters.method;
    if (!symmetric && method != KrylovMethod::automatic &&
        method != KrylovMethod::gmres)
      throw InputError("Linear solver/Method",
                       fmt::format("found {}; allowed: automatic or gmres, as "
                                   "this tangent is not symmetric",
                                   name_of(methods, method)));
  }
} // namespace corotet
