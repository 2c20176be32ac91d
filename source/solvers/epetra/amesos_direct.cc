// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/epetra/amesos_direct.h>

#include <deal.II/base/exceptions.h>

#include <Amesos.h>
#include <Epetra_Vector.h>

namespace corotet
{
  namespace
  {
    void
    check_step(const char *step, const int status)
    {
      AssertThrow(status == 0,
                  dealii::ExcMessage(std::string("Amesos' ") + step +
                                     " failed with status " +
                                     std::to_string(status) + "."));
    }
  } // namespace

  void
  AmesosDirect::build(const EffectiveOperator &A, const Vector &)
  {
    // The old factors refer to the old matrix, so they go first.
    factors.reset();
    matrix = std::make_unique<EpetraMatrix>(A.matrix());
    // Amesos' interface has no constant matrices, but it only reads.
    problem.SetOperator(const_cast<Epetra_CrsMatrix *>(&matrix->get()));
    Amesos            amesos;
    const auto *const type =
      amesos.Query("Amesos_Mumps") ? "Amesos_Mumps" : "Amesos_Klu";
    factors.reset(amesos.Create(type, problem));
    check_step("symbolic factorisation", factors->SymbolicFactorization());
    check_step("numeric factorisation", factors->NumericFactorization());
  }

  void
  AmesosDirect::vmult(Vector &dst, const Vector &src) const
  {
    Epetra_Vector x(View, matrix->rows(), dst.begin());
    Epetra_Vector b(View, matrix->rows(), const_cast<double *>(src.begin()));
    problem.SetLHS(&x);
    problem.SetRHS(&b);
    check_step("solve", factors->Solve());
  }
} // namespace corotet
