// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_aggregation_level_h
#define corotet_solvers_aggregation_level_h

#include <corotet/operators/block_matrix.h>
#include <corotet/solvers/node_graph.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * What the d unknowns of a point are when all space moves rigidly: those of a
   * node are the displacement at its place.
   */
  template <int d>
  struct PointFrame
  {
    dealii::Tensor<1, 3> centre;
  };

  /// Those of an aggregate are a product of its @p motions, by rows, with the
  /// displacement of its centre and the rotation about it.
  template <>
  struct PointFrame<6>
  {
    dealii::Tensor<1, 3>                 centre;
    std::array<std::array<double, 6>, 6> motions{};
  };

  /// Values of six motions, side by side.
  using Modes [[gnu::vector_size(64)]] = double;

  /**
   * What a level of aggregation leaves to the next one: six unknowns for each
   * aggregate.
   */
  struct AggregateProblem
  {
    /// Each aggregate is two nodes of three unknowns. Where this is the last
    /// level, its lower triangle.
    std::unique_ptr<BlockMatrix> matrix;
    /// Where it has blocks of 6 x 6; null if this is the last level.
    std::shared_ptr<const BlockPattern> aggregates;
    /// Of the owned ones.
    std::vector<PointFrame<6>> frames;
  };

  /// How the points of a level are aggregated.
  struct Coarsening
  {
    /// Aggregates join neighbours that move alike: their similarity, see
    /// AggregationLevel::similarities(), is at least this one times the largest
    /// of one of them [-]; with 0, all.
    double least_similarity = 0;
    /// More aggregates make a level with a next one, unless these are almost as
    /// many as the points.
    int most_aggregates = 330;
    /// More aggregates than these, of all neighbours, are joined by this many.
    unsigned int n_joined = 1;
  };

  /**
   * One level of smoothed aggregation: a matrix A whose points have d unknowns
   * each, 3 or 6, in single precision, its smoother, and the way to the level
   * of aggregates and back. See SmoothedAggregation.
   *
   * Members but those marked are collective.
   */
  template <int d>
  class AggregationLevel
  {
  public:
    /// @p degree of the smoother.
    explicit AggregationLevel(const unsigned int degree);

    /**
     * @p A has the blocks of @p pattern, in pieces of 3 x 3; @p frames are
     * those of the owned points. @p given_up: A, if it may be left without
     * values, which takes less memory, or null.
     */
    void
    build(const BlockMatrix                         &A,
          BlockMatrix                               *given_up,
          const std::shared_ptr<const BlockPattern> &pattern,
          const std::vector<PointFrame<d>>          &frames,
          const Coarsening                          &coarsening);

    /// Since the last build(). Not collective.
    const AggregateProblem &
    coarse() const
    {
      return problem;
    }

    /// Of all ranks. Not collective.
    int
    n_aggregates() const
    {
      return known_aggregates.n_global();
    }

    /// What A is divided by, a power of two, so that single precision holds it
    /// whatever its size is. Not collective.
    double
    unit() const
    {
      return the_unit;
    }

    /// The right-hand side of A / unit() x = b, owned entries. Not collective.
    float *
    right_hand_side() const
    {
      return rhs.data();
    }

    /// Owned entries first. Not collective.
    const float *
    solution() const
    {
      return x.data();
    }

    /// A Chebyshev polynomial of D^-1 A. D has the blocks of points, or, with a
    /// least similarity, those of aggregates.
    void
    smooth(const bool x_is_zero) const;

    /// coarse = P^T (b - A x).
    void
    restrict_residual(float *coarse) const;

    /// x += P coarse.
    void
    prolongate_add(const float *coarse) const;

  private:
    /// Six values for each unknown of a point.
    template <typename Number>
    struct ModeBlock
    {
      ModeBlock() = default;

      explicit ModeBlock(const std::array<Modes, d> &rows)
      {
        for (int a = 0; a < d; ++a)
          for (int m = 0; m < 6; ++m)
            values[a][m] = rows[a][m];
      }

      std::array<Modes, d>
      rows() const
      {
        std::array<Modes, d> result{};
        for (int a = 0; a < d; ++a)
          for (int m = 0; m < 6; ++m)
            result[a][m] = values[a][m];
        return result;
      }

      Number values[d][6]{};
    };
    /// Parts of rows of the coarse matrix: of each, the number at its owner and
    /// the entries.
    struct RowParts
    {
      /// With the entries since the last one.
      void
      add_row(const int row)
      {
        rows.push_back(row);
        entries.starts.push_back(entries.columns.size());
      }

      std::vector<int> rows;
      NodeGraph        entries;
    };

    /// Where the unknowns of point @p i begin, or those of a number of points
    /// end.
    static std::size_t
    offset(const std::size_t i)
    {
      return d * i;
    }

    /// target += the block from column @p k of @p rows times @p b.
    static void
    add_product(std::array<Modes, d>                &target,
                const std::array<const double *, d> &rows,
                const int                            k,
                const std::array<Modes, d>          &b)
    {
      for (int a = 0; a < d; ++a)
        for (int c = 0; c < d; ++c)
          target[a] += rows[a][k + c] * b[c];
    }

    /// Of @p A / unit, in single precision. @p given_up: see build().
    void
    copy_blocks(const BlockMatrix &A, BlockMatrix *given_up = nullptr);
    void
    copy_diagonal(const BlockMatrix &A);
    void
    invert_aggregates(const BlockMatrix &A);
    /// Owned entries in [-0.5, 0.5), others for each number.
    void
    fill_without_pattern(std::vector<float> &values,
                         const unsigned int  number) const;
    void
    estimate_largest_eigenvalue();
    /// How alike neighbours move, for each entry of the graph of points, zero
    /// for ghosts: the inverse of the squared difference of their
    /// displacements, in terms of the squares of both, when the smoother has
    /// been applied to motions without pattern (the algebraic distance; Brandt,
    /// Brannick, Kahl, Livshits 2015).
    std::vector<double>
    similarities(const std::vector<PointFrame<d>> &frames);
    void
    aggregate_points(const Coarsening                 &coarsening,
                     const std::vector<PointFrame<d>> &frames);
    void
    set_up_pattern(const Coarsening                 &coarsening,
                   const std::vector<PointFrame<d>> &frames);
    /// The entries of the prolongation, numbers of aggregates on all ranks, and
    /// their exchange. @p has_blocks: points of an aggregate have the same.
    void
    set_up_prolongation(const bool has_blocks);
    /// The entries of the owned rows of the coarse matrix, columns by global
    /// numbers, and who makes parts of them. @p is_last: its lower triangle.
    NodeGraph
    set_up_coarse_rows(const bool is_last);
    /// Gives other ranks those parts of their rows.
    void
    exchange_row_parts(const std::map<unsigned int, RowParts> &parts);
    void
    build_coarse(const BlockMatrix                &A,
                 const std::vector<PointFrame<d>> &frames);
    std::vector<ModeBlock<double>>
    rigid_motions(const std::vector<PointFrame<d>> &frames);
    void
    multiply_by_motions(std::array<Modes, d>                 *product,
                        const int                             i,
                        const BlockMatrix                    &A,
                        const std::vector<ModeBlock<double>> &motions,
                        std::vector<int>                     &place) const;
    /// @p result: an entry for each of the prolongation's pattern.
    void
    smooth_motions(std::vector<ModeBlock<double>>       &result,
                   const BlockMatrix                    &A,
                   const std::vector<ModeBlock<double>> &motions) const;
    void
    fill_coarse(const BlockMatrix                    &A,
                const std::vector<ModeBlock<double>> &exact);
    std::vector<int>
    coarse_numbers() const;
    void
    add_received_rows(BlockMatrix               &coarse,
                      const std::vector<double> &of_others) const;
    void
    apply(float *y, float *x) const;
    void
    scale(float *z, const float *r) const;
    template <typename Action>
    void
    for_each_diagonal_block(const Action &action) const;
    template <typename Action>
    void
    for_each_prolongation_block(const Action &action) const;

    const unsigned int degree;

    /// None before the first build().
    std::shared_ptr<const BlockPattern> points;
    int                                 n_points = 0;

    /// Used are aggregates that rows of owned points in the prolongation have;
    /// known are those that rows of ghosts have, too.
    NodeNumbers used_aggregates, known_aggregates;
    /// Of owned points and of ghosts; numbers of known ones.
    std::vector<int> aggregates;
    /// Rows are owned aggregates.
    NodeGraph points_of_aggregates;
    /// With rows of ghosts. Columns are known aggregates.
    NodeGraph     prolongation_pattern;
    GhostExchange prolongation_ghosts;
    /// Of the rows of owned points, as numbers of used aggregates.
    std::vector<int> prolongation_columns;
    GhostExchange    coarse_exchange;
    NodeGraph        product_pattern;
    /// Its lower triangle only, if this is the last level.
    std::shared_ptr<const BlockPattern> coarse_pattern;
    /// What owned points make of the rows of others' used aggregates, by known
    /// ones; and what others make of the owned rows: places of entries, by
    /// rank.
    NodeGraph                        rows_of_others;
    std::map<unsigned int, RowParts> received_rows;
    /// The same for matrices whose nodes come in twos.
    std::shared_ptr<const BlockPattern> coarse_matrix_pattern;
    AggregateProblem                    problem;

    double the_unit = 1;
    /// Blocks of A / unit and inverses of its diagonal blocks, by columns.
    dealii::AlignedVector<float> blocks;
    std::vector<float>           inverse_diagonal;
    std::vector<unsigned char>   is_prescribed;
    /// Inverses of the diagonal blocks of aggregates, by columns, where D has
    /// these.
    bool                     has_aggregate_blocks = false;
    std::vector<float>       inverse_aggregates;
    std::vector<std::size_t> starts_of_inverses;
    double                   largest_eigenvalue = 0;
    /// Rows of owned points.
    std::vector<ModeBlock<float>> prolongation;

    /// The first two with entries of ghosts.
    mutable std::vector<float> x, direction, rhs, residual, product, scaled;
    mutable std::vector<float> block_product;
    /// Six for each used aggregate.
    mutable std::vector<float> coarse_values;
  };
} // namespace corotet

#endif
