// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_direct_h
#define corotet_solvers_direct_h

#include <corotet/solvers/preconditioner.h>
#include <corotet/solvers/sparse_cholesky.h>

namespace corotet
{
  /**
   * The inverse by sparse factorisation. The factors of an older A serve as
   * preconditioner as long as a few iterations suffice: new rotations do not
   * force a new factorisation.
   */
  class DirectSolver : public Preconditioner
  {
  public:
    unsigned int
    acceptable_iterations(const unsigned int) const override
    {
      // A factorisation costs more than ten solves with it, for meshes that are
      // small enough to be factorised.
      return 10;
    }
  };

  /**
   * The inverse by CHOLMOD in double precision, on rank 0: of the tangent where
   * that is definite, else of the effective operator.
   */
  class CholeskyDirect : public DirectSolver
  {
  public:
    CholeskyDirect() = default;

    /// A copy has no factors.
    CholeskyDirect(const CholeskyDirect &)
      : DirectSolver()
    {}

    CholeskyDirect &
    operator=(const CholeskyDirect &) = delete;
    ~CholeskyDirect() override        = default;

    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    build_for(const EffectiveOperator &A,
              const TangentOperator   *J,
              const Vector            &displacement) override;

    void
    vmult(Vector &dst, const Vector &src) const override;

    bool
    is_worth_another(const unsigned int n_iterations) const override
    {
      return is_makeshift || (is_of_tangent && n_iterations > 10);
    }

  private:
    /// Returns false if the matrix is not positive definite.
    bool
    factorize(const BlockMatrix &matrix);

    SparseCholesky factors;
    /// Whether factors are those of a tangent or of a matrix close to it, and
    /// whether the tangent itself was not definite.
    bool is_of_tangent = false;
    bool is_makeshift  = false;
  };
} // namespace corotet

#endif
