// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/epetra/amesos_direct.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <Amesos.h>
#include <Amesos_ConfigDefs.h>
#include <Epetra_Vector.h>
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <iterator>
#ifdef HAVE_AMESOS_MUMPS
#  include <Amesos_Mumps.h>
#endif

namespace corotet
{
  namespace
  {
    // Errors of MUMPS, see INFOG(1) in its manual.
    constexpr int arrays_too_small[] = {-8, -9, -17, -20};
    constexpr int no_memory          = -13;

    // The error that MUMPS names, the same on all ranks, or else that of
    // Amesos; 0 if there is none.
    int
    error_code([[maybe_unused]] Amesos_BaseSolver &solver, const int status)
    {
#ifdef HAVE_AMESOS_MUMPS
      // Positive numbers are warnings.
      if (auto *const mumps = dynamic_cast<Amesos_Mumps *>(&solver);
          mumps != nullptr && mumps->GetINFOG()[0] < 0)
        return mumps->GetINFOG()[0];
#endif
      return status;
    }

    // Keeps Amesos from printing errors: they are reported otherwise, or are
    // none, as the factorisation is repeated.
    class Silence
    {
    public:
      Silence()
        : buffer(std::cerr.rdbuf(nullptr))
      {}

      ~Silence()
      {
        std::cerr.rdbuf(buffer);
      }

      Silence(const Silence &) = delete;
      Silence &
      operator=(const Silence &) = delete;

    private:
      std::streambuf *const buffer;
    };

    void
    enlarge_arrays([[maybe_unused]] Amesos_BaseSolver &solver,
                   [[maybe_unused]] const int          percent)
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
    const Silence silence;
    int           error = 0;
    // Numerical pivoting may need larger arrays than expected.
    for (const int percent : {0, 100, 400, 1600})
      {
        factors.reset(amesos.Create(type, problem));
        if (percent > 0)
          enlarge_arrays(*factors, percent);
        // Both return the same on all ranks.
        int status = factors->SymbolicFactorization();
        if (status == 0)
          status = factors->NumericFactorization();
        if (status == 0)
          return;
        const int found = error_code(*factors, status);
        // Later errors may come of arrays that were made too large.
        if (error == 0)
          error = found;
        if (std::ranges::find(arrays_too_small, found) ==
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
    const int status = factors->Solve();
    if (const int error = error_code(*factors, status); error != 0)
      throw LinearSolverError(
        fmt::format("the solution with factors ends with status {}", error));
  }
} // namespace corotet
