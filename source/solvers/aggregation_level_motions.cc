// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/aggregation_level.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  namespace
  {
    /// The values of a point's unknowns in six motions of all space:
    /// displacements along the axes, and rotations about the axes through
    /// @p centre.
    template <int d>
    std::array<Modes, d>
    motions_at(const PointFrame<d> &point, const dealii::Tensor<1, 3> &centre)
    {
      const auto           r = point.centre - centre;
      std::array<Modes, 3> translation{}, rotation{};
      for (int a = 0; a < 3; ++a)
        {
          const int b = (a + 1) % 3, c = (a + 2) % 3;
          translation[a].set(a, 1);
          translation[a].set(3 + b, r[c]);
          translation[a].set(3 + c, -r[b]);
          rotation[a].set(3 + a, 1);
        }
      if constexpr (d == 3)
        return translation;
      else
        {
          std::array<Modes, 6> result{};
          for (int m = 0; m < 6; ++m)
            for (int a = 0; a < 3; ++a)
              {
                result[m].add(point.motions[m][a], translation[a]);
                result[m].add(point.motions[m][3 + a], rotation[a]);
              }
          return result;
        }
    }

    /// Makes six vectors orthonormal by the Gram-Schmidt process: component i
    /// of vector m is rows[i][m]. A dependent vector becomes zero if its
    /// remainder is only round-off of the translations, which come first, or of
    /// the rotations.
    void
    make_orthonormal(std::vector<Modes> &rows)
    {
      const auto dot = [&](const int m, const int l) {
        double sum = 0;
        for (const Modes &row : rows)
          sum += row[m] * row[l];
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
                row.set(m, row[m] - part * row[l]);
            }
          const double left = dot(m, m);
          const double scale =
            left > 1e-8 * largest[m / 3] ? 1 / std::sqrt(left) : 0.;
          for (Modes &row : rows)
            row.set(m, scale * row[m]);
        }
    }
  } // namespace

  /// The rigid motions of owned points and ghosts with their aggregates;
  /// orthonormal for each aggregate, zero where A has a prescribed unknown, or
  /// where an aggregate is too small for six motions. Fills the frames of
  /// aggregates.
  template <int d>
  std::vector<typename AggregationLevel<d>::ModeBlock>
  AggregationLevel<d>::rigid_motions(const std::vector<PointFrame<d>> &frames)
  {
    std::vector<ModeBlock> motions(points->exchange().n_items());
    problem.frames.assign(points_of_aggregates.n_rows(), PointFrame<6>());
    std::vector<Modes> rows, rigid_rows;
    for (int g = 0; g < points_of_aggregates.n_rows(); ++g)
      {
        const int *begin =
          &points_of_aggregates.columns[points_of_aggregates.starts[g]];
        const int n =
          points_of_aggregates.starts[g + 1] - points_of_aggregates.starts[g];
        PointFrame<6> &frame = problem.frames[g];
        for (int i = 0; i < n; ++i)
          frame.centre += frames[begin[i]].centre / n;
        rigid_rows.clear();
        for (int i = 0; i < n; ++i)
          {
            const auto point = motions_at(frames[begin[i]], frame.centre);
            for (int a = 0; a < d; ++a)
              rigid_rows.push_back(is_prescribed[d * begin[i] + a] ? Modes{} :
                                                                     point[a]);
          }
        rows = rigid_rows;
        make_orthonormal(rows);
        for (int i = 0; i < n; ++i)
          {
            ModeBlock of_point;
            std::copy_n(&rows[offset(i)], d, of_point.begin());
            motions[begin[i]] = of_point;
          }
        for (int i = 0; i < d * n; ++i)
          for (int m = 0; m < 6; ++m)
            for (int l = 0; l < 6; ++l)
              frame.motions[m][l] += rows[i][m] * rigid_rows[i][l];
      }
    points->exchange().update(motions.data());
    return motions;
  }

  /// Row @p i of A / unit times the motions, for each column in the
  /// prolongation's row. @p place has an entry for each known aggregate and is
  /// overwritten.
  template <int d>
  void
  AggregationLevel<d>::multiply_by_motions(
    ModeBlock                    *product,
    const int                     i,
    const BlockMatrix            &A,
    const std::vector<ModeBlock> &motions,
    std::vector<int>             &place) const
  {
    const NodeGraph &graph = points->graph();
    const int        first = prolongation_pattern.starts[i];
    const int        n     = prolongation_pattern.starts[i + 1] - first;
    for (int k = 0; k < n; ++k)
      {
        place[prolongation_pattern.columns[first + k]] = k;
        product[k]                                     = ModeBlock();
      }
    const auto rows = A.template rows_of<d>(i);
    for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k)
      add_product(product[place[aggregates[graph.columns[k]]]],
                  rows,
                  d * (k - graph.starts[i]),
                  motions[graph.columns[k]]);
    for (int k = 0; k < n; ++k)
      for (Modes &row : product[k])
        row *= 1 / the_unit;
  }

  /// Calls action(points, their number, inverse) for each diagonal block of D,
  /// which couples these points; its inverse is given by columns.
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

  /// Computes the prolongation, with rows of ghosts: the product of I - omega
  /// D^-1 A / unit and the motions, with omega = 4/3 over the largest
  /// eigenvalue.
  template <int d>
  void
  AggregationLevel<d>::smooth_motions(
    std::vector<ModeBlock>       &result,
    const BlockMatrix            &A,
    const std::vector<ModeBlock> &motions) const
  {
    const double           omega = 4. / 3 / largest_eigenvalue;
    std::vector<ModeBlock> products;
    std::vector<int>       place(known_aggregates.n_local());
    // All points of a block have the same columns in the prolongation.
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
                            place);
      for (int i = 0; i < n; ++i)
        for (int k = 0; k < n_columns; ++k)
          {
            const int entry = starts[own[i]] + k;
            ModeBlock rows{};
            if (prolongation_pattern.columns[entry] == aggregates[own[i]])
              rows = motions[own[i]];
            for (int j = 0; j < n; ++j)
              for (int b = 0; b < d; ++b)
                for (int a = 0; a < d; ++a)
                  rows[a].add(-omega * inverse[d * n * (d * j + b) + d * i + a],
                              products[n_columns * j + k][b]);
            result[entry] = rows;
          }
    });
    prolongation_ghosts.update(result.data());
  }

  // These members are instantiated one by one, as others are in files of their
  // own.
  template std::vector<AggregationLevel<3>::ModeBlock>
  AggregationLevel<3>::rigid_motions(const std::vector<PointFrame<3>> &);
  template std::vector<AggregationLevel<6>::ModeBlock>
  AggregationLevel<6>::rigid_motions(const std::vector<PointFrame<6>> &);
  template void
  AggregationLevel<3>::smooth_motions(
    std::vector<AggregationLevel<3>::ModeBlock> &,
    const BlockMatrix &,
    const std::vector<AggregationLevel<3>::ModeBlock> &) const;
  template void
  AggregationLevel<6>::smooth_motions(
    std::vector<AggregationLevel<6>::ModeBlock> &,
    const BlockMatrix &,
    const std::vector<AggregationLevel<6>::ModeBlock> &) const;
} // namespace corotet
