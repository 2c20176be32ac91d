// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_static_solve_h
#define corotet_benchmarks_static_solve_h

#include "case_data.h"

namespace corotet::benchmarks
{
  constexpr double static_tolerance = 1e-8;

  /// The relative residual |b - A x| / |b| with the matrix-free operator, which
  /// other benchmarks check.
  inline double
  residual(CaseData &data, const Vector &x, const Vector &b)
  {
    Vector r(b);
    data.effective().vmult(r, x);
    r -= b;
    return r.l2_norm() / b.l2_norm();
  }

  /// Solves by conjugate gradients with @p A; the preconditioner is made from
  /// the effective operator.
  template <typename Operator>
  Counters
  solve(CaseData &data, const Operator &A, Preconditioner &P)
  {
    const Vector b = data.problem().weight();
    Vector       x(b);
    Counters     result;
    result["unknowns"] = data.problem().n_unknowns();
    result["setup_s"]  = seconds(
      [&] { P.build(data.effective(), data.problem().state_of_solves()); });
    result["solve_s"]  = seconds([&] {
      result["cg_iterations"] =
        conjugate_gradients(A, x, b, P, static_tolerance);
    });
    result["residual"] = residual(data, x, b);
    result["seconds"]  = result["setup_s"] + result["solve_s"];
    return result;
  }
} // namespace corotet::benchmarks

#endif
