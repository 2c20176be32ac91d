// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <cmath>

namespace corotet
{
  using Modes [[gnu::vector_size(64)]] = double;

  struct SmoothedAggregation::Block
  {
    std::array<Modes, 3> rows{};
  };

  namespace
  {
    using Rows = std::array<double *, 3>;

    Rows
    node_rows(const Epetra_CrsMatrix &A, const int node)
    {
      Rows rows;
      int  length;
      for (int a = 0; a < 3; ++a)
        A.ExtractMyRowView(3 * node + a, length, rows[a]);
      return rows;
    }

    /// target += the block of the matrix from column k on times b.
    template <typename Block>
    void
    add_product(Block &target, const Rows &rows, const int k, const Block &b)
    {
      for (int a = 0; a < 3; ++a)
        target.rows[a] += rows[a][k] * b.rows[0] + rows[a][k + 1] * b.rows[1] +
                          rows[a][k + 2] * b.rows[2];
    }
  } // namespace

  void
  SmoothedAggregation::build_coarse(const Epetra_CrsMatrix &A,
                                    const double           *positions)
  {
    std::vector<Block> motions(n_nodes);
    std::vector<Block> prolongation(prolongation_pattern.columns.size());
    rigid_motions(motions, positions);
    smooth_motions(prolongation, A, motions);
    factorize(coarse_matrix(A, prolongation));
  }

  /// Those of each aggregate about its centre, orthonormal; zero where A has a
  /// prescribed unknown, or where an aggregate is too small to have six.
  void
  SmoothedAggregation::rigid_motions(std::vector<Block> &motions,
                                     const double       *positions) const
  {
    for (int g = 0; g < n_aggregates(); ++g)
      {
        const int *begin =
          &nodes_of_aggregates.columns[nodes_of_aggregates.starts[g]];
        const int n =
          nodes_of_aggregates.starts[g + 1] - nodes_of_aggregates.starts[g];
        const auto position = [&](const int i) {
          const double *x = positions + 3 * begin[i];
          return dealii::Tensor<1, 3>({x[0], x[1], x[2]});
        };
        dealii::Tensor<1, 3> centre;
        for (int i = 0; i < n; ++i)
          centre += position(i) / n;
        for (int i = 0; i < n; ++i)
          {
            Block     &block = motions[begin[i]];
            const auto r     = position(i) - centre;
            for (int a = 0; a < 3; ++a)
              {
                // Translation along axis a, rotation about it: e_a x r.
                const int b          = (a + 1) % 3;
                const int c          = (a + 2) % 3;
                block.rows[a][a]     = 1;
                block.rows[b][3 + a] = -r[c];
                block.rows[c][3 + a] = r[b];
              }
            for (int a = 0; a < 3; ++a)
              if (is_prescribed[3 * begin[i] + a])
                block.rows[a] = Modes{};
          }
        make_orthonormal(motions, g);
      }
  }

  /// Gram and Schmidt's way; what is left of a dependent motion is zero.
  void
  SmoothedAggregation::make_orthonormal(std::vector<Block> &motions,
                                        const int           aggregate) const
  {
    const int *begin =
      &nodes_of_aggregates.columns[nodes_of_aggregates.starts[aggregate]];
    const int n = nodes_of_aggregates.starts[aggregate + 1] -
                  nodes_of_aggregates.starts[aggregate];
    const auto product = [&](const int m, const int l) {
      double sum = 0;
      for (int i = 0; i < n; ++i)
        for (const Modes &row : motions[begin[i]].rows)
          sum += row[m] * row[l];
      return sum;
    };
    for (int m = 0; m < 6; ++m)
      {
        const double before = product(m, m);
        for (int l = 0; l < m; ++l)
          {
            const double part = product(m, l);
            for (int i = 0; i < n; ++i)
              for (Modes &row : motions[begin[i]].rows)
                row[m] -= part * row[l];
          }
        const double after = product(m, m);
        const double scale = after > 1e-8 * before ? 1 / std::sqrt(after) : 0.;
        for (int i = 0; i < n; ++i)
          for (Modes &row : motions[begin[i]].rows)
            row[m] *= scale;
      }
  }

  /// (I - omega D^-1 A) times the motions, omega = 4/3 over the largest
  /// eigenvalue.
  void
  SmoothedAggregation::smooth_motions(std::vector<Block>       &prolongation,
                                      const Epetra_CrsMatrix   &A,
                                      const std::vector<Block> &motions)
  {
    const double     omega = 4. / 3 / largest_eigenvalue;
    std::vector<int> place(n_aggregates());
    prolongation_blocks.resize(18 * prolongation.size());
    for (int i = 0; i < n_nodes; ++i)
      {
        const int begin = prolongation_pattern.starts[i];
        const int end   = prolongation_pattern.starts[i + 1];
        for (int k = begin; k < end; ++k)
          place[prolongation_pattern.columns[k]] = k;
        const Rows rows = node_rows(A, i);
        for (int k = pattern.starts[i]; k < pattern.starts[i + 1]; ++k)
          {
            const int j = pattern.columns[k];
            add_product(prolongation[place[aggregates[j]]],
                        rows,
                        3 * (k - pattern.starts[i]),
                        motions[j]);
          }
        const float *inverse = &inverse_diagonal[9 * i];
        for (int k = begin; k < end; ++k)
          {
            const Block product = prolongation[k];
            Block      &block   = prolongation[k];
            for (int a = 0; a < 3; ++a)
              {
                block.rows[a] = -omega * (inverse[a] * product.rows[0] +
                                          inverse[3 + a] * product.rows[1] +
                                          inverse[6 + a] * product.rows[2]);
                if (prolongation_pattern.columns[k] == aggregates[i])
                  block.rows[a] += motions[i].rows[a];
                for (int m = 0; m < 6; ++m)
                  prolongation_blocks[18 * k + 6 * a + m] = block.rows[a][m];
              }
          }
      }
  }

  /// P^T A P: 6 x 6 blocks by rows, in the order of the coarse pattern.
  std::vector<double>
  SmoothedAggregation::coarse_matrix(
    const Epetra_CrsMatrix   &A,
    const std::vector<Block> &prolongation) const
  {
    std::vector<std::array<Modes, 6>> matrix(coarse_pattern.columns.size());
    std::vector<int>                  place(n_aggregates());
    std::vector<Block>                row_blocks;
    for (int i = 0; i < n_nodes; ++i)
      {
        const int *columns =
          &product_pattern.columns[product_pattern.starts[i]];
        const int n = product_pattern.starts[i + 1] - product_pattern.starts[i];
        row_blocks.assign(n, Block());
        for (int k = 0; k < n; ++k)
          place[columns[k]] = k;
        const Rows rows = node_rows(A, i);
        for (int k = pattern.starts[i]; k < pattern.starts[i + 1]; ++k)
          {
            const int j = pattern.columns[k];
            for (int l = prolongation_pattern.starts[j];
                 l < prolongation_pattern.starts[j + 1];
                 ++l)
              add_product(row_blocks[place[prolongation_pattern.columns[l]]],
                          rows,
                          3 * (k - pattern.starts[i]),
                          prolongation[l]);
          }
        for (int l = prolongation_pattern.starts[i];
             l < prolongation_pattern.starts[i + 1];
             ++l)
          {
            const int    I     = prolongation_pattern.columns[l];
            const Block &p     = prolongation[l];
            int          entry = coarse_pattern.starts[I];
            for (int k = 0; k < n && columns[k] <= I; ++k)
              {
                while (coarse_pattern.columns[entry] != columns[k])
                  ++entry;
                const Block &s = row_blocks[k];
                for (int m = 0; m < 6; ++m)
                  matrix[entry][m] += p.rows[0][m] * s.rows[0] +
                                      p.rows[1][m] * s.rows[1] +
                                      p.rows[2][m] * s.rows[2];
              }
          }
      }
    std::vector<double> values;
    values.reserve(36 * matrix.size());
    for (const auto &block : matrix)
      for (const Modes &row : block)
        for (int m = 0; m < 6; ++m)
          values.push_back(row[m]);
    return values;
  }

  /// Hands the lower triangle to the factor; motions that an aggregate lacks
  /// get a 1 on the diagonal.
  void
  SmoothedAggregation::fill_coarse(const std::vector<double> &matrix)
  {
    int    *starts  = coarse_factor->row_starts();
    int    *columns = coarse_factor->columns();
    int     entry   = 0;
    float  *singles = static_cast<float *>(coarse_factor->values());
    double *doubles = static_cast<double *>(coarse_factor->values());
    for (int i = 0; i < n_aggregates(); ++i)
      for (int m = 0; m < 6; ++m)
        {
          starts[6 * i + m] = entry;
          for (int k = coarse_pattern.starts[i];
               k < coarse_pattern.starts[i + 1];
               ++k)
            {
              const int j = coarse_pattern.columns[k];
              for (int l = 0; l < (i == j ? m + 1 : 6); ++l, ++entry)
                {
                  double value =
                    matrix[36 * static_cast<std::size_t>(k) + 6 * m + l];
                  if (i == j && l == m && value == 0)
                    value = 1;
                  columns[entry] = 6 * j + l;
                  if (coarse_factor->is_single())
                    singles[entry] = value;
                  else
                    doubles[entry] = value;
                }
            }
        }
    starts[6 * n_aggregates()] = entry;
  }

  void
  SmoothedAggregation::factorize(const std::vector<double> &matrix)
  {
    const bool is_new = !coarse_factor;
    if (is_new)
      coarse_factor =
        std::make_unique<CholmodFactor>(6 * n_aggregates(),
                                        36 * coarse_pattern.columns.size() -
                                          15 * n_aggregates(),
                                        true);
    fill_coarse(matrix);
    if (is_new)
      coarse_factor->analyze();
    if (coarse_factor->factorize())
      return;
    if (coarse_factor->is_single())
      {
        coarse_factor->convert_to_double();
        fill_coarse(matrix);
        if (coarse_factor->factorize())
          return;
      }
    clear();
    throw ComputationError(
      "the stiffness matrix is singular: the body or a part of it can move "
      "without resistance, because not enough is prescribed");
  }
} // namespace corotet
