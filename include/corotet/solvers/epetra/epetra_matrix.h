// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_epetra_epetra_matrix_h
#define corotet_solvers_epetra_epetra_matrix_h

#include <corotet/operators/block_matrix.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>

#include <memory>

namespace corotet
{
  /**
   * A BlockMatrix as Trilinos' packages of the first generation see it: its
   * numbers without a copy, so that they follow it, and a copy of its pattern.
   */
  class EpetraMatrix
  {
  public:
    /// @p A must live as long as the numbers are asked for. Collective.
    explicit EpetraMatrix(const BlockMatrix &A);

    /// Whether this is a view of what @p A has now.
    bool
    shows(const BlockMatrix &A) const
    {
      return A.pattern() == pattern && A.values_begin() == values;
    }

    const Epetra_CrsMatrix &
    get() const
    {
      return *matrix;
    }

    /// Rows, and entries of owned vectors.
    const Epetra_Map &
    rows() const
    {
      return owned;
    }

    /// dst = A src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

  private:
    /// Kept, so that no other one has its address.
    const std::shared_ptr<const BlockPattern> pattern;
    const double *const                       values;
    const Epetra_MpiComm                      comm;
    const Epetra_Map                          owned;
    std::unique_ptr<Epetra_CrsMatrix>         matrix;
  };
} // namespace corotet

#endif
