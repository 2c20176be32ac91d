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
      "where that is faster, as on thin bodies of few cells across; "
      "'p-multigrid', matrix-free multigrid over the polynomial degrees from "
      "that of the elements down to 1; 'amg', smoothed aggregation with rigid "
      "body modes by Trilinos ML, on the assembled matrix (where Trilinos has "
      "ML); 'jacobi', the diagonal; 'direct', a sparse factorisation of the "
      "assembled matrix.");
    add_enumeration(prm,
                    "Method",
                    method,
                    methods,
                    "Krylov method. 'automatic': for symmetric systems "
                    "conjugate gradients, and MINRES where these turn out to "
                    "be indefinite; for other systems flexible conjugate "
                    "gradients, and GMRES where these are slow. Other systems "
                    "allow 'automatic' and 'gmres' only. GMRES is flexible and "
                    "restarted after 30 iterations, or up to 200 where its "
                    "vectors take less than 64 MiB; they take nearly as much "
                    "memory as all the rest.");
    add_enumeration(prm,
                    "Operator",
                    is_assembled,
                    operators,
                    "How the matrix is applied in the iterations: "
                    "'matrix-free', cell by cell without storing it; "
                    "'assembled', as a sparse matrix, which takes more memory "
                    "and, except with linear elasticity, needs 'Newton/Tangent "
                    "= frozen rotation' and rotations other than at quadrature "
                    "points.");
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Residual at which the iterations stop, relative to the "
                      "right hand side [-]. Linear systems of Newton "
                      "iterations that are not expected to be the last are "
                      "solved less accurately, as far as their convergence "
                      "allows.",
                      dealii::Patterns::Double(1e-15, 0.1));
    prm.add_parameter("Maximum iterations",
                      max_iterations,
                      "Largest number of iterations of a linear solve [-]. A "
                      "solve that needs more has failed. With an exact tangent "
                      "a solve has failed after 1,000 iterations already (with "
                      "a factorisation as preconditioner after fewer, at least "
                      "100); then the frozen tangent is used.",
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
