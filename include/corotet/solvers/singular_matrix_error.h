// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_singular_matrix_error_h
#define corotet_solvers_singular_matrix_error_h

#include <corotet/base/exceptions.h>

namespace corotet
{
  /**
   * A matrix that must be positive definite is singular, up to round-off:
   * another try with the same matrix would fail again.
   */
  class SingularMatrixError : public ComputationError
  {
  public:
    using ComputationError::ComputationError;
  };
} // namespace corotet

#endif
