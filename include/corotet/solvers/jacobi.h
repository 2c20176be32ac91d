// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_jacobi_h
#define corotet_solvers_jacobi_h

#include <corotet/solvers/preconditioner.h>

#include <deal.II/lac/diagonal_matrix.h>

namespace corotet
{
  /**
   * Preconditions with the inverse diagonal of the present operator.
   */
  class Jacobi : public Preconditioner
  {
  public:
    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    update(const EffectiveOperator &A) override;

    void
    vmult(Vector &dst, const Vector &src) const override;

  private:
    dealii::DiagonalMatrix<Vector> inverse_diagonal;
  };
} // namespace corotet

#endif
