// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "sparse_matrices.h"

#include <deal.II/base/exceptions.h>

#include <Epetra_CrsMatrix.h>

namespace corotet::benchmarks
{
  CsrView
  csr_view(const dealii::TrilinosWrappers::SparseMatrix &matrix)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    int                    *row_starts, *columns;
    double                 *values;
    AssertThrow(epetra.Comm().NumProc() == 1, dealii::ExcNotImplemented());
    AssertThrow(epetra.ExtractCrsDataPointers(row_starts, columns, values) == 0,
                dealii::ExcMessage("The matrix is not in compressed rows."));
    const int n = epetra.NumMyRows();
    return CsrView(n, n, epetra.NumMyNonzeros(), row_starts, columns, values);
  }

  BlockMatrix::BlockMatrix(const CsrView &matrix)
    : row_starts{0}
  {
    const int *starts = matrix.outerIndexPtr();
    const int  n_rows = matrix.rows();
    columns.reserve(matrix.nonZeros() / 9);
    values.reserve(matrix.nonZeros() + 1);
    for (int row = 0; row < n_rows; row += 3)
      {
        for (int k = 0; k < starts[row + 1] - starts[row]; k += 3)
          {
            const int *found = matrix.innerIndexPtr() + starts[row] + k;
            AssertThrow(found[0] % 3 == 0 && found[2] == found[0] + 2,
                        dealii::ExcMessage("The matrix has no 3 x 3 blocks."));
            columns.push_back(found[0]);
            for (int b = 0; b < 3; ++b)
              for (int a = 0; a < 3; ++a)
                values.push_back(matrix.valuePtr()[starts[row + a] + k + b]);
          }
        row_starts.push_back(columns.size());
      }
    values.push_back(0);
  }

  void
  BlockMatrix::vmult(double *y, const double *x) const
  {
    using Four = SimdVector<double, 4>;
    for (std::size_t row = 0; row + 1 < row_starts.size(); ++row)
      {
        Four sum[3] = {};
        for (std::size_t k = row_starts[row]; k < row_starts[row + 1]; ++k)
          for (int b = 0; b < 3; ++b)
            sum[b] +=
              load_unaligned<4>(&values[9 * k + 3 * b]) * x[columns[k] + b];
        sum[0] += sum[1] + sum[2];
        for (int a = 0; a < 3; ++a)
          y[3 * row + a] = sum[0][a];
      }
  }
} // namespace corotet::benchmarks
