// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_sparse_matrices_h
#define corotet_benchmarks_sparse_matrices_h

#include <corotet/base/simd.h>
#include <corotet/operators/block_matrix.h>

#include <vector>

#include <Eigen/SparseCore>

namespace corotet::benchmarks
{
  /// Compressed rows as Eigen uses them, in memory that belongs to others.
  using CsrView =
    Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor, int>>;

  /**
   * A matrix in compressed rows with an index for each number. Its numbers are
   * those of the block matrix, without a copy. One rank only.
   */
  class CompressedRows
  {
  public:
    /// @p matrix must live as long as this object.
    explicit CompressedRows(const BlockMatrix &matrix);

    CsrView
    view() const;

  private:
    const BlockMatrix &matrix;
    std::vector<int>   row_starts;
    std::vector<int>   columns;
  };

  /**
   * Compressed rows of 3 x 3 blocks: one column index per block, and one
   * register of four numbers per column of a block (the fourth belongs to the
   * next column).
   */
  class RegisterBlocks
  {
  public:
    /// Rows and columns of @p matrix must come in threes with the same pattern.
    explicit RegisterBlocks(const CsrView &matrix);

    /// y = A x.
    void
    vmult(double *y, const double *x) const;

    std::size_t
    n_blocks() const
    {
      return columns.size();
    }

  private:
    std::vector<std::size_t> row_starts;
    std::vector<int>         columns;
    /// Values as [block][column][row], and one number more at the end.
    std::vector<double> values;
  };
} // namespace corotet::benchmarks

#endif
