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
   * A BlockMatrix in the form of Trilinos' packages of the first generation.
   * Its values are not copied, so that they follow it; its pattern is.
   */
  class EpetraMatrix
  {
  public:
    /// @p A must live as long as values are used. Collective.
    explicit EpetraMatrix(const BlockMatrix &A);

    /// Whether this is a view of the present values of @p A.
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

    /// The map of the rows, and of owned vectors.
    const Epetra_Map &
    rows() const
    {
      return owned;
    }

    /// dst = A src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

  private:
    /// The pattern is kept so that no other one can get its address.
    const std::shared_ptr<const BlockPattern> pattern;
    const double *const                       values;
    const Epetra_MpiComm                      comm;
    const Epetra_Map                          owned;
    std::unique_ptr<Epetra_CrsMatrix>         matrix;
  };
} // namespace corotet

#endif
