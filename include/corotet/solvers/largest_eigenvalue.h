// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_largest_eigenvalue_h
#define corotet_solvers_largest_eigenvalue_h

#include <corotet/base/vector.h>

#include <functional>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The generalized eigenvalue problem K x = lambda M x with symmetric K and
   * positive definite M, given by functions that apply them to a vector. The
   * first argument is the result, complete on owned entries. All functions are
   * collective.
   */
  struct SymmetricPencil
  {
    using Operator = std::function<void(Vector &, const Vector &)>;

    Operator stiffness;
    Operator mass;
    Operator inverse_mass;
  };

  /**
   * An upper bound of the largest eigenvalue by the Lanczos method in the inner
   * product of M: the largest Ritz value theta plus its residual norm, when
   * that has been below @p tolerance theta for some steps. There is an
   * eigenvalue so near to theta [Parlett, The symmetric eigenvalue problem,
   * 1998, theorem 4.5.1]. It is the largest one unless @p start has next to
   * nothing of that one's direction: let all unknowns have similar shares of
   * the norm of @p start. @p start comes out changed. Throws ComputationError
   * if there is no convergence or a number is not finite. Collective.
   */
  double
  largest_eigenvalue(const SymmetricPencil &pencil,
                     Vector                &start,
                     const double           tolerance);

  /// The largest eigenvalue of the symmetric tridiagonal matrix with these
  /// entries, and the absolute value of the last entry of its unit eigenvector.
  std::pair<double, double>
  largest_of_tridiagonal(const std::vector<double> &diagonal,
                         const std::vector<double> &beside);
} // namespace corotet

#endif
