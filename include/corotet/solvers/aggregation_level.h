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
   * The values of the d unknowns of a point when all space moves rigidly. For a
   * node they are the displacement at its place.
   */
  template <int d>
  struct PointFrame
  {
    dealii::Tensor<1, 3> centre;
  };

  /// For an aggregate they are the product of its @p motions, by rows, with the
  /// displacement of its centre and the rotation about it.
  template <>
  struct PointFrame<6>
  {
    dealii::Tensor<1, 3>                 centre;
    std::array<std::array<double, 6>, 6> motions{};
  };

  /**
   * Values of six motions, side by side in a register of four and one of two:
   * wider registers would have to be put together first.
   */
  struct Modes
  {
    using Four [[gnu::vector_size(32), gnu::aligned(16)]] = double;
    using Two [[gnu::vector_size(16)]]                    = double;

    double
    operator[](const int m) const
    {
      return m < 4 ? first[m] : last[m - 4];
    }

    void
    set(const int m, const double value)
    {
      if (m < 4)
        first[m] = value;
      else
        last[m - 4] = value;
    }

    Modes &
    operator*=(const double factor)
    {
      first *= factor;
      last *= factor;
      return *this;
    }

    /// Adds @p factor times @p b.
    void
    add(const double factor, const Modes &b)
    {
      first += factor * b.first;
      last += factor * b.last;
    }

    Four first{};
    Two  last{};
  };
  static_assert(sizeof(Modes) == 6 * sizeof(double));

  /**
   * The problem that a level of aggregation hands to the next one: six unknowns
   * for each aggregate.
   */
  struct AggregateProblem
  {
    /// The matrix; each aggregate is two nodes of three unknowns. On the last
    /// level it is the lower triangle only.
    std::unique_ptr<BlockMatrix> matrix;
    /// The pattern of the matrix's blocks of 6 x 6; null on the last level.
    std::shared_ptr<const BlockPattern> aggregates;
    /// The frames of the owned aggregates.
    std::vector<PointFrame<6>> frames;
  };

  /// How the points of a level are aggregated.
  struct Coarsening
  {
    /// Aggregates join neighbours that move alike: the similarity of two
    /// points, see AggregationLevel::similarities(), must be at least this one
    /// times the largest similarity of one of them [-]; 0 joins all neighbours.
    double least_similarity = 0;
    /// With more aggregates than these there is a next level, unless they are
    /// almost as many as the points.
    int most_aggregates = 330;
    /// If there are more aggregates than most_aggregates, and they are made of
    /// all neighbours, this number of them is joined.
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
    /// @p degree is that of the smoother.
    explicit AggregationLevel(const unsigned int degree);

    /**
     * @p A has the blocks of @p pattern, in pieces of 3 x 3; @p frames are
     * those of the owned points. @p given_up is A if it may be left without
     * values, which takes less memory, or null.
     */
    void
    build(const BlockMatrix                         &A,
          BlockMatrix                               *given_up,
          const std::shared_ptr<const BlockPattern> &pattern,
          const std::vector<PointFrame<d>>          &frames,
          const Coarsening                          &coarsening);

    /// The problem of the last build(). Not collective.
    const AggregateProblem &
    coarse() const
    {
      return problem;
    }

    /// The number of aggregates on all ranks. Not collective.
    int
    n_aggregates() const
    {
      return known_aggregates.n_global();
    }

    /// The divisor of A, a power of two, with which single precision holds A
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

    /// The solution, owned entries first. Not collective.
    const float *
    solution() const
    {
      return x.data();
    }

    /// Applies a Chebyshev polynomial of D^-1 A. D has the blocks of points,
    /// or, with a least similarity, those of aggregates.
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
    using ModeBlock  = std::array<Modes, d>;
    using FloatModes = std::array<std::array<float, 6>, d>;

    /// Parts of rows of the coarse matrix: the number of each row at its owner,
    /// and its entries.
    struct RowParts
    {
      /// Ends a row with the entries since the last one.
      void
      add_row(const int row)
      {
        rows.push_back(row);
        entries.starts.push_back(entries.columns.size());
      }

      std::vector<int> rows;
      NodeGraph        entries;
    };

    /// The first unknown of point @p i, or the number of unknowns of @p i
    /// points.
    static std::size_t
    offset(const std::size_t i)
    {
      return d * i;
    }

    /// target += the block from column @p k of @p rows times @p b.
    static void
    add_product(ModeBlock                           &target,
                const std::array<const double *, d> &rows,
                const int                            k,
                const ModeBlock                     &b)
    {
      for (int a = 0; a < d; ++a)
        for (int c = 0; c < d; ++c)
          target[a].add(rows[a][k + c], b[c]);
    }

    /// Copies the blocks of @p A / unit in single precision. @p given_up: see
    /// build().
    void
    copy_blocks(const BlockMatrix &A, BlockMatrix *given_up = nullptr);
    void
    copy_diagonal(const BlockMatrix &A);
    void
    invert_aggregates(const BlockMatrix &A);
    /// Owned entries become numbers in [-0.5, 0.5) without pattern, which
    /// differ for each @p number.
    void
    fill_without_pattern(std::vector<float> &values,
                         const unsigned int  number) const;
    void
    estimate_largest_eigenvalue();
    /// How alike neighbours move, for each entry of the graph of points, zero
    /// for ghosts: the inverse of the squared difference of their
    /// displacements, relative to the squares of both, after the smoother has
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
    /// Sets up the entries of the prolongation, the numbers of aggregates on
    /// all ranks, and the exchange. With @p has_blocks the points of an
    /// aggregate have the same entries.
    void
    set_up_prolongation(const bool has_blocks);
    /// Finds the entries of the owned rows of the coarse matrix, with global
    /// column numbers, and the ranks that make parts of them. With @p is_last
    /// these are the entries of the lower triangle.
    NodeGraph
    set_up_coarse_rows(const bool is_last);
    /// Gives other ranks those parts of their rows.
    void
    exchange_row_parts(const std::map<unsigned int, RowParts> &parts);
    void
    build_coarse(const BlockMatrix                &A,
                 const std::vector<PointFrame<d>> &frames);
    std::vector<ModeBlock>
    rigid_motions(const std::vector<PointFrame<d>> &frames);
    void
    multiply_by_motions(ModeBlock                    *product,
                        const int                     i,
                        const BlockMatrix            &A,
                        const std::vector<ModeBlock> &motions,
                        std::vector<int>             &place) const;
    /// @p result has an entry for each one of the prolongation's pattern.
    void
    smooth_motions(std::vector<ModeBlock>       &result,
                   const BlockMatrix            &A,
                   const std::vector<ModeBlock> &motions) const;
    void
    fill_coarse(const BlockMatrix &A, const std::vector<ModeBlock> &exact);
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

    /// Pattern of the points; null before the first build().
    std::shared_ptr<const BlockPattern> points;
    int                                 n_points = 0;

    /// The used aggregates are those in the prolongation's rows of owned
    /// points; the known aggregates are those in its rows of ghosts, too.
    NodeNumbers used_aggregates, known_aggregates;
    /// The known aggregate of each owned point and ghost.
    std::vector<int> aggregates;
    /// The points of each owned aggregate (rows).
    NodeGraph points_of_aggregates;
    /// The prolongation's pattern, with rows of ghosts. Columns are known
    /// aggregates.
    NodeGraph     prolongation_pattern;
    GhostExchange prolongation_ghosts;
    /// The columns in the rows of owned points, as numbers of used aggregates.
    std::vector<int> prolongation_columns;
    GhostExchange    coarse_exchange;
    NodeGraph        product_pattern;
    /// The coarse matrix's pattern; its lower triangle only, if this is the
    /// last level.
    std::shared_ptr<const BlockPattern> coarse_pattern;
    /// Entries that owned points contribute to rows of other ranks' aggregates,
    /// with known ones as columns; and the places of the entries of owned rows
    /// to which other ranks contribute, by rank.
    NodeGraph                        rows_of_others;
    std::map<unsigned int, RowParts> received_rows;
    /// The same pattern for matrices with two nodes for each aggregate.
    std::shared_ptr<const BlockPattern> coarse_matrix_pattern;
    AggregateProblem                    problem;

    double the_unit = 1;
    /// Blocks of A / unit and inverses of its diagonal blocks, by columns.
    dealii::AlignedVector<float> blocks;
    std::vector<float>           inverse_diagonal;
    std::vector<unsigned char>   is_prescribed;
    /// Inverses of the diagonal blocks of aggregates, by columns, if D has
    /// these blocks.
    bool                     has_aggregate_blocks = false;
    std::vector<float>       inverse_aggregates;
    std::vector<std::size_t> starts_of_inverses;
    double                   largest_eigenvalue = 0;
    /// The prolongation's rows of owned points.
    std::vector<FloatModes> prolongation;

    /// The first two of these vectors have entries of ghosts.
    mutable std::vector<float> x, direction, rhs, residual, product, scaled;
    mutable std::vector<float> block_product;
    /// Six values for each used aggregate.
    mutable std::vector<float> coarse_values;
  };
} // namespace corotet

#endif
