// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/epetra/amesos_direct.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <deal.II/base/mpi.h>

#include <Amesos.h>
#include <Amesos_ConfigDefs.h>
#include <fmt/format.h>

#include <algorithm>
#ifdef HAVE_AMESOS_MUMPS
#  include <Amesos_Mumps.h>
#endif
#include <Epetra_Vector.h>

namespace corotet
{
  namespace
  {
    // Errors of MUMPS, see INFOG(1) in its manual.
    constexpr int arrays_too_small[] = {-8, -9, -17, -20};
    constexpr int no_memory          = -13;

    // The error that MUMPS names, or that of Amesos.
    int
    error_code(Amesos_BaseSolver &solver, const int status)
    {
#ifdef HAVE_AMESOS_MUMPS
      if (auto *const mumps = dynamic_cast<Amesos_Mumps *>(&solver);
          mumps != nullptr && status != 0)
        return mumps->GetINFOG()[0];
#endif
      return status;
    }

    void
    enlarge_arrays(Amesos_BaseSolver &solver, const int percent)
    {
#ifdef HAVE_AMESOS_MUMPS
      // ICNTL(14): by how much arrays are larger than MUMPS thinks necessary.
      if (auto *const mumps = dynamic_cast<Amesos_Mumps *>(&solver))
        mumps->SetICNTL(14, percent);
#endif
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
    const MPI_Comm comm  = A.discretization().communicator();
    int            error = 0;
    // Numerical pivoting may need larger arrays than expected.
    for (const int percent : {0, 100, 400, 1600})
      {
        factors.reset(amesos.Create(type, problem));
        if (percent > 0)
          enlarge_arrays(*factors, percent);
        int status = factors->SymbolicFactorization();
        if (dealii::Utilities::MPI::min(status, comm) == 0)
          status = factors->NumericFactorization();
        error = dealii::Utilities::MPI::min(error_code(*factors, status), comm);
        if (error == 0)
          return;
        if (std::ranges::find(arrays_too_small, error) ==
            std::end(arrays_too_small))
          break;
      }
    factors.reset();
    const auto n = matrix->get().NumGlobalRows64();
    if (error == no_memory)
      throw MachineError(fmt::format(
        "memory is too short to factorise a matrix with {} unknowns", n));
    throw LinearSolverError(
      fmt::format("the matrix with {} unknowns cannot be factorised: {} ends "
                  "with status {}",
                  n,
                  type,
                  error));
  }

  void
  AmesosDirect::vmult(Vector &dst, const Vector &src) const
  {
    Epetra_Vector x(View, matrix->rows(), dst.begin());
    Epetra_Vector b(View, matrix->rows(), const_cast<double *>(src.begin()));
    problem.SetLHS(&x);
    problem.SetRHS(&b);
    if (const int status = factors->Solve(); status != 0)
      throw LinearSolverError(
        fmt::format("Amesos' solution fails with status {}", status));
  }
} // namespace corotet
