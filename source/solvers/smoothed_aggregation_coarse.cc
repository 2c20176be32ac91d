// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace corotet
{
  using Modes [[gnu::vector_size(64)]] = double;

  struct SmoothedAggregation::ProlongationBlock
  {
    std::array<Modes, 3> rows{};
  };

  /// The coarse unknowns' motions of the nodes, and of an aggregate as if it
  /// filled all space.
  struct SmoothedAggregation::Motions
  {
    struct Aggregate
    {
      ProlongationBlock
      at(const dealii::Tensor<1, 3> &x) const
      {
        const auto        r = x - centre;
        ProlongationBlock block(translation);
        for (int a = 0; a < 3; ++a)
          {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            block.rows[a] += rotation.rows[b] * r[c] - rotation.rows[c] * r[b];
          }
        return block;
      }

      dealii::Tensor<1, 3> centre;
      /// Of the centre, and about it.
      ProlongationBlock translation, rotation;
    };

    std::vector<ProlongationBlock> nodes;
    std::vector<Aggregate>         aggregates;
  };

  namespace
  {
    using Rows = std::array<const double *, 3>;

    dealii::Tensor<1, 3>
    position(const std::vector<double> &positions, const int i)
    {
      return dealii::Tensor<1, 3>(
        {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
    }

    /// Motions that an aggregate lacks get a 1 on the diagonal. A row of the
    /// matrix has its owned columns first.
    void
    copy_blocks(BlockMatrix                             &matrix,
                const NodeGraph                         &pattern,
                const std::vector<std::array<Modes, 6>> &blocks,
                const int                                first)
    {
      for (int i = 0; i < pattern.n_rows(); ++i)
        {
          const int  begin = pattern.starts[i];
          const int  end   = pattern.starts[i + 1];
          const auto owned = std::lower_bound(pattern.columns.begin() + begin,
                                              pattern.columns.begin() + end,
                                              first);
          const int  n_ghosts = owned - pattern.columns.begin() - begin;
          for (int m = 0; m < 6; ++m)
            {
              double *values = matrix.row(2 * i + m / 3, m % 3);
              for (int k = begin; k < end; ++k)
                {
                  const int place =
                    (k - begin + end - begin - n_ghosts) % (end - begin);
                  for (int l = 0; l < 6; ++l)
                    values[6 * place + l] = blocks[k][m][l];
                }
              // The diagonal block is the last of the owned ones.
              double &diagonal = values[6 * (end - begin - n_ghosts - 1) + m];
              if (diagonal == 0)
                diagonal = 1;
            }
        }
    }

    /// Makes the columns of the first n blocks orthonormal, in Gram and
    /// Schmidt's way, and combines those of the others likewise; what is left
    /// of a dependent column is zero.
    template <typename ProlongationBlock>
    void
    make_orthonormal(std::vector<ProlongationBlock> &blocks, const int n)
    {
      const auto product = [&](const int m, const int l) {
        double sum = 0;
        for (int i = 0; i < n; ++i)
          for (const Modes &row : blocks[i].rows)
            sum += row[m] * row[l];
        return sum;
      };
      for (int m = 0; m < 6; ++m)
        {
          const double before = product(m, m);
          for (int l = 0; l < m; ++l)
            {
              const double part = product(m, l);
              for (ProlongationBlock &block : blocks)
                for (Modes &row : block.rows)
                  row[m] -= part * row[l];
            }
          const double after = product(m, m);
          const double scale =
            after > 1e-8 * before ? 1 / std::sqrt(after) : 0.;
          for (ProlongationBlock &block : blocks)
            for (Modes &row : block.rows)
              row[m] *= scale;
        }
    }

    /// target += the block of the matrix from column k on times b.
    template <typename ProlongationBlock>
    void
    add_product(ProlongationBlock       &target,
                const Rows              &rows,
                const int                k,
                const ProlongationBlock &b)
    {
      for (int a = 0; a < 3; ++a)
        target.rows[a] += rows[a][k] * b.rows[0] + rows[a][k + 1] * b.rows[1] +
                          rows[a][k + 2] * b.rows[2];
    }
  } // namespace

  void
  SmoothedAggregation::build_coarse(const BlockMatrix &A,
                                    const double      *positions)
  {
    std::vector<double> all_positions(positions, positions + 3 * n_nodes);
    all_positions.resize(3 * pattern->exchange().n_items());
    pattern->exchange().update(all_positions.data(), 3);
    std::vector<ProlongationBlock> prolongation(
      prolongation_pattern.columns.size());
    smooth_motions(prolongation,
                   A,
                   rigid_motions(all_positions),
                   all_positions);
    prolongation_ghosts.update(prolongation.data());
    fill_coarse(A, prolongation);
    coarse_factor.factorize(*coarse_matrix);
  }

  /// Those of each aggregate, orthonormal; zero where A has a prescribed
  /// unknown, or where an aggregate is too small to have six.
  SmoothedAggregation::Motions
  SmoothedAggregation::rigid_motions(const std::vector<double> &positions) const
  {
    const int n_own = nodes_of_aggregates.n_rows();
    Motions   motions;
    motions.nodes.resize(n_nodes);
    motions.aggregates.resize(n_own);
    std::vector<ProlongationBlock> blocks;
    for (int g = 0; g < n_own; ++g)
      {
        const int *begin =
          &nodes_of_aggregates.columns[nodes_of_aggregates.starts[g]];
        const int n =
          nodes_of_aggregates.starts[g + 1] - nodes_of_aggregates.starts[g];
        // Translations along the axes, and rotations about them.
        Motions::Aggregate &rigid = motions.aggregates[g];
        for (int i = 0; i < n; ++i)
          rigid.centre += position(positions, begin[i]) / n;
        for (int a = 0; a < 3; ++a)
          {
            rigid.translation.rows[a][a]  = 1;
            rigid.rotation.rows[a][3 + a] = 1;
          }
        blocks.clear();
        for (int i = 0; i < n; ++i)
          {
            blocks.push_back(rigid.at(position(positions, begin[i])));
            for (int a = 0; a < 3; ++a)
              if (is_prescribed[3 * begin[i] + a])
                blocks.back().rows[a] = Modes{};
          }
        blocks.push_back(rigid.translation);
        blocks.push_back(rigid.rotation);
        make_orthonormal(blocks, n);
        for (int i = 0; i < n; ++i)
          motions.nodes[begin[i]] = blocks[i];
        rigid.translation = blocks[n];
        rigid.rotation    = blocks[n + 1];
      }
    return motions;
  }

  /// (I - omega D^-1 A) times the motions, omega = 4/3 over the largest
  /// eigenvalue; D is that of A / unit. A ghost moves with the aggregate of the
  /// row.
  void
  SmoothedAggregation::smooth_motions(
    std::vector<ProlongationBlock> &prolongation,
    const BlockMatrix              &A,
    const Motions                  &motions,
    const std::vector<double>      &positions)
  {
    const double     omega = 4. / 3 / largest_eigenvalue / unit;
    const NodeGraph &graph = pattern->graph();
    std::vector<int> place(n_aggregates());
    prolongation_blocks.resize(18 * prolongation_pattern.starts[n_nodes]);
    for (int i = 0; i < n_nodes; ++i)
      {
        const int begin = prolongation_pattern.starts[i];
        const int end   = prolongation_pattern.starts[i + 1];
        for (int k = begin; k < end; ++k)
          place[prolongation_pattern.columns[k]] = k;
        const Rows rows = A.rows(i);
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          {
            const int  j        = graph.columns[k];
            const bool is_ghost = j >= n_nodes;
            const int  g        = aggregates[is_ghost ? i : j];
            add_product(prolongation[place[g]],
                        rows,
                        3 * (k - graph.starts[i]),
                        is_ghost ? motions.aggregates[g - first_aggregate].at(
                                     position(positions, j)) :
                                   motions.nodes[j]);
          }
        const float *inverse = &inverse_diagonal[9 * i];
        for (int k = begin; k < end; ++k)
          {
            const ProlongationBlock product = prolongation[k];
            ProlongationBlock      &block   = prolongation[k];
            for (int a = 0; a < 3; ++a)
              {
                block.rows[a] = -omega * (inverse[a] * product.rows[0] +
                                          inverse[3 + a] * product.rows[1] +
                                          inverse[6 + a] * product.rows[2]);
                if (prolongation_pattern.columns[k] == aggregates[i])
                  block.rows[a] += motions.nodes[i].rows[a];
                for (int m = 0; m < 6; ++m)
                  prolongation_blocks[18 * k + 6 * a + m] = block.rows[a][m];
              }
          }
      }
  }

  /// P^T A P / unit, lower triangle.
  void
  SmoothedAggregation::fill_coarse(
    const BlockMatrix                    &A,
    const std::vector<ProlongationBlock> &prolongation)
  {
    const NodeGraph                  &graph = pattern->graph();
    std::vector<std::array<Modes, 6>> matrix(coarse_pattern.columns.size());
    std::vector<int>                  place(n_aggregates());
    std::vector<ProlongationBlock>    row_blocks;
    for (int i = 0; i < n_nodes; ++i)
      {
        const int *columns =
          &product_pattern.columns[product_pattern.starts[i]];
        const int n = product_pattern.starts[i + 1] - product_pattern.starts[i];
        row_blocks.assign(n, ProlongationBlock());
        for (int k = 0; k < n; ++k)
          place[columns[k]] = k;
        const Rows rows = A.rows(i);
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          {
            const int j = graph.columns[k];
            for (int l = prolongation_pattern.starts[j];
                 l < prolongation_pattern.starts[j + 1];
                 ++l)
              add_product(row_blocks[place[prolongation_pattern.columns[l]]],
                          rows,
                          3 * (k - graph.starts[i]),
                          prolongation[l]);
          }
        for (int l = prolongation_pattern.starts[i];
             l < prolongation_pattern.starts[i + 1];
             ++l)
          {
            const int         I = prolongation_pattern.columns[l];
            ProlongationBlock p = prolongation[l];
            int entry           = coarse_pattern.starts[I - first_aggregate];
            for (Modes &row : p.rows)
              row /= unit;
            for (int k = 0; k < n && columns[k] <= I; ++k)
              {
                while (coarse_pattern.columns[entry] != columns[k])
                  ++entry;
                const ProlongationBlock &s = row_blocks[k];
                for (int m = 0; m < 6; ++m)
                  matrix[entry][m] += p.rows[0][m] * s.rows[0] +
                                      p.rows[1][m] * s.rows[1] +
                                      p.rows[2][m] * s.rows[2];
              }
          }
      }
    copy_blocks(*coarse_matrix, coarse_pattern, matrix, first_aggregate);
  }
} // namespace corotet
