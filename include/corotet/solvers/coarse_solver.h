// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_coarse_solver_h
#define corotet_solvers_coarse_solver_h

#include <corotet/base/selectable.h>
#include <corotet/operators/block_matrix.h>

#include <vector>

namespace corotet
{
  /**
   * A further solver for degree 1 in p-multigrid, beside those of its own: an
   * approximate inverse of a symmetric positive definite matrix, which is
   * symmetric and positive definite, too.
   */
  class CoarseSolver
  {
  public:
    virtual ~CoarseSolver() = default;

    /// @p positions are those of the owned nodes [m]. @p A must live as long as
    /// vmult() is called. Collective.
    virtual void
    build(const BlockMatrix &A, const Vector &positions) = 0;

    /// dst = P src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;
  };

  using CoarseSolvers = std::vector<Candidate<CoarseSolver>>;
} // namespace corotet

#endif
