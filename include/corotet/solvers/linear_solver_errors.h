// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_linear_solver_errors_h
#define corotet_solvers_linear_solver_errors_h

#include <corotet/base/exceptions.h>

namespace corotet
{
  /**
   * A linear system could not be solved: another try with the same matrix would
   * fail again.
   */
  class LinearSolverError : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };

  /**
   * A matrix that must be positive definite is singular, up to round-off.
   */
  class SingularMatrixError : public LinearSolverError
  {
  public:
    using LinearSolverError::LinearSolverError;
  };
} // namespace corotet

#endif
