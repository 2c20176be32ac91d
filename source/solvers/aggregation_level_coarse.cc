// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/aggregation_level.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace corotet
{
  namespace
  {
    template <int d>
    using Rows = std::array<const double *, d>;

    /// What the unknowns of a point are when all space moves so.
    template <int d, typename SpaceMotions>
    std::array<Modes, d>
    motions_at(const PointFrame<d> &point, const SpaceMotions &space)
    {
      const auto           r           = point.centre - space.centre;
      std::array<Modes, 3> translation = space.translation;
      for (int a = 0; a < 3; ++a)
        {
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          translation[a] += space.rotation[b] * r[c] - space.rotation[c] * r[b];
        }
      if constexpr (d == 3)
        return translation;
      else
        {
          std::array<Modes, 6> result{};
          for (int m = 0; m < 6; ++m)
            for (int a = 0; a < 3; ++a)
              result[m] += point.motions[m][a] * translation[a] +
                           point.motions[m][3 + a] * space.rotation[a];
          return result;
        }
    }

    /// Makes six vectors orthonormal, in Gram and Schmidt's way: component i
    /// of vector m is rows[i][m] for i < n. What is left of a dependent one is
    /// zero: as small as round-off of the translations, which come first, or of
    /// the rotations. Combines the columns of the rows behind these likewise.
    void
    make_orthonormal(std::vector<Modes> &rows, const std::size_t n)
    {
      const auto dot = [&](const int m, const int l) {
        double sum = 0;
        for (std::size_t i = 0; i < n; ++i)
          sum += rows[i][m] * rows[i][l];
        return sum;
      };
      std::array<double, 2> largest{};
      for (int m = 0; m < 6; ++m)
        largest[m / 3] = std::max(largest[m / 3], dot(m, m));
      for (int m = 0; m < 6; ++m)
        {
          for (int l = 0; l < m; ++l)
            {
              const double part = dot(m, l);
              for (Modes &row : rows)
                row[m] -= part * row[l];
            }
          const double left = dot(m, m);
          const double scale =
            left > 1e-8 * largest[m / 3] ? 1 / std::sqrt(left) : 0.;
          for (Modes &row : rows)
            row[m] *= scale;
        }
    }

    /// target += the block of the matrix from column k on times b.
    template <int d>
    void
    add_product(std::array<Modes, d>       &target,
                const Rows<d>              &rows,
                const int                   k,
                const std::array<Modes, d> &b)
    {
      for (int a = 0; a < d; ++a)
        for (int c = 0; c < d; ++c)
          target[a] += rows[a][k + c] * b[c];
    }
  } // namespace

  /// The coarse unknowns' motions of the owned points, and of each aggregate as
  /// if it filled all space.
  template <int d>
  struct AggregationLevel<d>::Motions
  {
    /// Six motions of all space: displacements of @p centre, and rotations
    /// about it.
    struct OfSpace
    {
      dealii::Tensor<1, 3> centre;
      std::array<Modes, 3> translation{}, rotation{};
    };

    std::vector<std::array<Modes, d>> points;
    std::vector<OfSpace>              aggregates;
  };

  template <int d>
  void
  AggregationLevel<d>::build_coarse(const BlockMatrix         &A,
                                    std::vector<PointFrame<d>> frames)
  {
    frames.resize(points->exchange().n_items());
    points->exchange().update(frames.data());
    // Room for one at a time.
    prolongation     = {};
    const auto exact = smoothed_motions(A, rigid_motions(frames), frames);
    fill_coarse(A, exact);
    prolongation.resize(prolongation_pattern.starts[n_points]);
    for (std::size_t k = 0; k < prolongation.size(); ++k)
      std::copy_n(&exact[k].values[0][0], 6 * d, &prolongation[k].values[0][0]);
  }

  /// Those of each aggregate, orthonormal; zero where A has a prescribed
  /// unknown, or where an aggregate is too small to have six. Fills the frames
  /// of aggregates.
  template <int d>
  typename AggregationLevel<d>::Motions
  AggregationLevel<d>::rigid_motions(const std::vector<PointFrame<d>> &frames)
  {
    const int n_own = points_of_aggregates.n_rows();
    Motions   motions;
    motions.points.resize(n_points);
    motions.aggregates.resize(n_own);
    problem.frames.resize(n_own);
    std::vector<Modes> rows, rigid_rows;
    for (int g = 0; g < n_own; ++g)
      {
        const int *begin =
          &points_of_aggregates.columns[points_of_aggregates.starts[g]];
        const int n =
          points_of_aggregates.starts[g + 1] - points_of_aggregates.starts[g];
        // Translations along the axes, and rotations about them.
        typename Motions::OfSpace &space = motions.aggregates[g];
        for (int i = 0; i < n; ++i)
          space.centre += frames[begin[i]].centre / n;
        for (int a = 0; a < 3; ++a)
          {
            space.translation[a][a]  = 1;
            space.rotation[a][3 + a] = 1;
          }
        rigid_rows.clear();
        for (int i = 0; i < n; ++i)
          {
            const auto point = motions_at(frames[begin[i]], space);
            for (int a = 0; a < d; ++a)
              rigid_rows.push_back(is_prescribed[d * begin[i] + a] ? Modes{} :
                                                                     point[a]);
          }
        rows = rigid_rows;
        rows.insert(rows.end(),
                    space.translation.begin(),
                    space.translation.end());
        rows.insert(rows.end(), space.rotation.begin(), space.rotation.end());
        make_orthonormal(rows, offset(n));
        for (int i = 0; i < n; ++i)
          std::copy_n(&rows[offset(i)], d, motions.points[begin[i]].begin());
        std::copy_n(&rows[offset(n)], 3, space.translation.begin());
        std::copy_n(&rows[offset(n) + 3], 3, space.rotation.begin());

        PointFrame<6> &frame = problem.frames[g];
        frame                = PointFrame<6>();
        frame.centre         = space.centre;
        for (int i = 0; i < d * n; ++i)
          for (int m = 0; m < 6; ++m)
            for (int l = 0; l < 6; ++l)
              frame.motions[m][l] += rows[i][m] * rigid_rows[i][l];
      }
    return motions;
  }

  /// Row @p i of A / unit times the motions, for each column of the row of the
  /// prolongation. Ghosts move with the aggregate of the row. @p place: for
  /// each owned aggregate, overwritten.
  template <int d>
  void
  AggregationLevel<d>::multiply_by_motions(
    std::array<Modes, d>             *product,
    const int                         i,
    const BlockMatrix                &A,
    const Motions                    &motions,
    const std::vector<PointFrame<d>> &frames,
    std::vector<int>                 &place) const
  {
    const NodeGraph &graph = points->graph();
    const int        first = prolongation_pattern.starts[i];
    const int        n     = prolongation_pattern.starts[i + 1] - first;
    for (int k = 0; k < n; ++k)
      {
        place[prolongation_pattern.columns[first + k] - first_aggregate] = k;
        product[k] = std::array<Modes, d>();
      }
    const Rows<d> rows = A.template rows_of<d>(i);
    for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
      {
        const int  j        = graph.columns[k];
        const bool is_ghost = j >= n_points;
        const int  g        = aggregates[is_ghost ? i : j] - first_aggregate;
        add_product<d>(product[place[g]],
                       rows,
                       d * (k - graph.starts[i]),
                       is_ghost ? motions_at(frames[j], motions.aggregates[g]) :
                                  motions.points[j]);
      }
    for (int k = 0; k < n; ++k)
      for (Modes &row : product[k])
        row /= the_unit;
  }

  /// Calls action(points, their number, inverse) for each diagonal block of D,
  /// which has the unknowns of these points; its inverse is given by columns.
  template <int d>
  template <typename Action>
  void
  AggregationLevel<d>::for_each_diagonal_block(const Action &action) const
  {
    if (has_aggregate_blocks)
      for (int g = 0; g < points_of_aggregates.n_rows(); ++g)
        {
          const int begin = points_of_aggregates.starts[g];
          action(&points_of_aggregates.columns[begin],
                 points_of_aggregates.starts[g + 1] - begin,
                 &inverse_aggregates[starts_of_inverses[g]]);
        }
    else
      for (int i = 0; i < n_points; ++i)
        action(&i, 1, &inverse_diagonal[d * offset(i)]);
  }

  /// The prolongation, with rows of ghosts: the product of
  /// I - omega D^-1 A / unit and the motions, omega = 4/3 over the largest
  /// eigenvalue.
  template <int d>
  std::vector<typename AggregationLevel<d>::template ProlongationBlock<double>>
  AggregationLevel<d>::smoothed_motions(
    const BlockMatrix                &A,
    const Motions                    &motions,
    const std::vector<PointFrame<d>> &frames)
  {
    std::vector<ProlongationBlock<double>> result(
      prolongation_pattern.columns.size());
    const double                      omega = 4. / 3 / largest_eigenvalue;
    std::vector<std::array<Modes, d>> products;
    std::vector<int>                  place(points_of_aggregates.n_rows());
    // Points of one block have the same columns in the prolongation.
    for_each_diagonal_block([&](const int   *own,
                                const int    n,
                                const float *inverse) {
      const auto &starts    = prolongation_pattern.starts;
      const int   n_columns = starts[own[0] + 1] - starts[own[0]];
      products.resize(static_cast<std::size_t>(n) * n_columns);
      for (int i = 0; i < n; ++i)
        multiply_by_motions(&products[static_cast<std::size_t>(i) * n_columns],
                            own[i],
                            A,
                            motions,
                            frames,
                            place);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n_columns; ++k)
          {
            const int            entry = starts[own[i]] + k;
            std::array<Modes, d> rows{};
            if (prolongation_pattern.columns[entry] == aggregates[own[i]])
              rows = motions.points[own[i]];
            for (int j = 0; j < n; ++j)
              for (int b = 0; b < d; ++b)
                for (int a = 0; a < d; ++a)
                  rows[a] -= omega * inverse[d * n * (d * j + b) + d * i + a] *
                             products[n_columns * j + k][b];
            for (int a = 0; a < d; ++a)
              for (int m = 0; m < 6; ++m)
                result[entry].values[a][m] = rows[a][m];
          }
    });
    prolongation_ghosts.update(result.data());
    return result;
  }

  /// Where the entries of a row of the coarse pattern, which have global
  /// numbers, are in the matrix: owned ones first.
  template <int d>
  struct AggregationLevel<d>::CoarseRow
  {
    CoarseRow(const NodeGraph &pattern, const int first, const int i)
      : begin(pattern.starts[i])
    {
      const auto columns = [&](const int number) {
        const auto start = pattern.columns.begin() + begin;
        const auto end   = pattern.columns.begin() + pattern.starts[i + 1];
        return static_cast<int>(std::lower_bound(start, end, number) - start);
      };
      n_below = columns(first);
      n_owned = columns(first + pattern.n_rows()) - n_below;
      own     = place(begin + columns(first + i));
    }

    int
    place(const int entry) const
    {
      const int k = entry - begin;
      if (k < n_below)
        return n_owned + k;
      return k < n_below + n_owned ? k - n_below : k;
    }

    int begin, n_below, n_owned, own;
  };

  /// P^T A P / unit. Motions that an aggregate lacks get a 1 on the diagonal.
  template <int d>
  void
  AggregationLevel<d>::fill_coarse(
    const BlockMatrix                            &A,
    const std::vector<ProlongationBlock<double>> &exact)
  {
    problem.matrix = std::make_unique<BlockMatrix>(coarse_matrix_pattern);
    const NodeGraph                  &graph  = points->graph();
    BlockMatrix                      &coarse = *problem.matrix;
    std::vector<int>                  place(n_all_aggregates);
    std::vector<std::array<Modes, d>> row_blocks;
    std::vector<CoarseRow>            coarse_rows;
    for (int I = 0; I < coarse_pattern.n_rows(); ++I)
      coarse_rows.emplace_back(coarse_pattern, first_aggregate, I);
    for (int i = 0; i < n_points; ++i)
      {
        const int *columns =
          &product_pattern.columns[product_pattern.starts[i]];
        const int n = product_pattern.starts[i + 1] - product_pattern.starts[i];
        row_blocks.assign(n, std::array<Modes, d>());
        for (int k = 0; k < n; ++k)
          place[columns[k]] = k;
        const Rows<d> rows = A.template rows_of<d>(i);
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
          {
            const int j = graph.columns[k];
            for (int l = prolongation_pattern.starts[j];
                 l < prolongation_pattern.starts[j + 1];
                 ++l)
              add_product<d>(row_blocks[place[prolongation_pattern.columns[l]]],
                             rows,
                             d * (k - graph.starts[i]),
                             exact[l].rows());
          }
        for (int l = prolongation_pattern.starts[i];
             l < prolongation_pattern.starts[i + 1];
             ++l)
          {
            const int I = prolongation_pattern.columns[l] - first_aggregate;
            const int last =
              coarse_pattern.columns[coarse_pattern.starts[I + 1] - 1];
            const auto target = coarse.template rows_of<6>(I);
            int        entry  = coarse_pattern.starts[I];
            auto       p      = exact[l].rows();
            for (Modes &row : p)
              row /= the_unit;
            for (int k = 0; k < n && columns[k] <= last; ++k)
              {
                while (coarse_pattern.columns[entry] != columns[k])
                  ++entry;
                const int column = 6 * coarse_rows[I].place(entry);
                for (int m = 0; m < 6; ++m)
                  {
                    Modes sum = p[0][m] * row_blocks[k][0];
                    for (int a = 1; a < d; ++a)
                      sum += p[a][m] * row_blocks[k][a];
                    for (int b = 0; b < 6; ++b)
                      target[m][column + b] += sum[b];
                  }
              }
          }
      }
    for (int I = 0; I < coarse_pattern.n_rows(); ++I)
      for (int m = 0; m < 6; ++m)
        if (double &diagonal =
              coarse.template rows_of<6>(I)[m][6 * coarse_rows[I].own + m];
            diagonal == 0)
          diagonal = 1;
  }

  template void
  AggregationLevel<3>::build_coarse(const BlockMatrix &,
                                    std::vector<PointFrame<3>>);
  template void
  AggregationLevel<6>::build_coarse(const BlockMatrix &,
                                    std::vector<PointFrame<6>>);
} // namespace corotet
