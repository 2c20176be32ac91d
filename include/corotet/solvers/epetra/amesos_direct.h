// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_epetra_amesos_direct_h
#define corotet_solvers_epetra_amesos_direct_h

#include <corotet/solvers/direct.h>
#include <corotet/solvers/epetra/epetra_matrix.h>

#include <Amesos_BaseSolver.h>
#include <Epetra_LinearProblem.h>

#include <memory>

namespace corotet
{
  /**
   * The inverse by sparse factorisation on all ranks (MUMPS where Trilinos has
   * it, else KLU, through Amesos).
   */
  class AmesosDirect : public DirectSolver
  {
  public:
    AmesosDirect() = default;

    /// A copy has no factors.
    AmesosDirect(const AmesosDirect &)
      : DirectSolver()
    {}

    AmesosDirect &
    operator=(const AmesosDirect &) = delete;
    ~AmesosDirect() override        = default;

    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    vmult(Vector &dst, const Vector &src) const override;

  private:
    std::unique_ptr<EpetraMatrix>              matrix;
    mutable Epetra_LinearProblem               problem;
    mutable std::unique_ptr<Amesos_BaseSolver> factors;
  };
} // namespace corotet

#endif
