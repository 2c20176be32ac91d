// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "sparse_matrices.h"

#include <deal.II/base/exceptions.h>

namespace corotet::benchmarks
{
  CompressedRows::CompressedRows(const BlockMatrix &matrix)
    : matrix(matrix)
    , row_starts{0}
  {
    const BlockPattern &pattern = *matrix.pattern();
    const NodeGraph    &graph   = pattern.graph();
    AssertThrow(pattern.n_owned() == pattern.nodes().n_global(),
                dealii::ExcNotImplemented());
    columns.reserve(matrix.n_values());
    for (int row = 0; row < 3 * pattern.n_owned(); ++row)
      {
        for (int k = graph.starts[row / 3]; k < graph.starts[row / 3 + 1]; ++k)
          for (int b = 0; b < 3; ++b)
            columns.push_back(3 * graph.columns[k] + b);
        row_starts.push_back(columns.size());
      }
  }

  CsrView
  CompressedRows::view() const
  {
    const int n = row_starts.size() - 1;
    return CsrView(n,
                   n,
                   columns.size(),
                   row_starts.data(),
                   columns.data(),
                   matrix.values_begin());
  }

  RegisterBlocks::RegisterBlocks(const CsrView &matrix)
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
  RegisterBlocks::vmult(double *y, const double *x) const
  {
    using Four = SimdVector<double, 4>;
    for (std::size_t row = 0; row + 1 < row_starts.size(); ++row)
      {
        Four sum[3] = {};
        for (std::size_t k = row_starts[row]; k < row_starts[row + 1]; ++k)
          for (int b = 0; b < 3; ++b)
            sum[b] +=
              load_unaligned<4>(&values[3 * (3 * k + b)]) * x[columns[k] + b];
        sum[0] += sum[1] + sum[2];
        for (int a = 0; a < 3; ++a)
          y[3 * row + a] = sum[0][a];
      }
  }
} // namespace corotet::benchmarks
