// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_smoothed_aggregation_h
#define corotet_solvers_smoothed_aggregation_h

#include <corotet/operators/block_matrix.h>
#include <corotet/solvers/node_graph.h>
#include <corotet/solvers/sparse_cholesky.h>

#include <array>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * One cycle of smoothed aggregation (Vanek, Mandel, Brezina 1996) with two
   * levels for a stiffness matrix A of 3 x 3 blocks, in single precision:
   * symmetric and positive definite.
   *
   * The coarse unknowns are the six rigid body motions of every aggregate of
   * nodes, smoothed by one step of damped block Jacobi; they are found by a
   * sparse factorisation on rank 0. The smoother is Chebyshev's polynomial of
   * D^-1 A, D the diagonal blocks. What the coarse level is made of is computed
   * in double precision; patterns are kept while that of A is the same.
   *
   * Aggregates stay within a rank, and so do their smoothed motions: the step
   * of damped Jacobi takes a neighbour on another rank to move with the
   * aggregate, so that rigid motions of the body remain what they are.
   */
  class SmoothedAggregation
  {
  public:
    /// @p degree of the smoother.
    explicit SmoothedAggregation(const unsigned int degree = 3);

    /// From the next pattern on, nodes are aggregated along strong couplings
    /// only: |A_ij| / sqrt(|A_ii| |A_jj|) of these is at least @p strength
    /// times the largest of node i or of node j [-]. With 0, which it is
    /// without this call, all are strong. Flat and stretched cells need
    /// about 0.3: their weak couplings leave errors rough that an aggregate
    /// across them takes for smooth. On stretched ones it makes 1.6, on flat
    /// ones 4 times as many aggregates.
    void
    set_strength(const double strength)
    {
      least_strength = strength;
    }

    /// @p positions: three coordinates per owned node [m]. Throws
    /// SingularMatrixError if A is singular. Collective.
    void
    build(const BlockMatrix &A, const double *positions);

    /// dst = P src, owned entries, for float or double. Only the first call
    /// allocates memory. Collective.
    template <typename Number>
    void
    vmult(Number *dst, const Number *src) const;

    /// Of all ranks.
    int
    n_aggregates() const
    {
      return coarse_matrix->pattern()->n_global() / 2;
    }

  private:
    /// Three rows of a block with a column per rigid motion, and two of zeros.
    struct ProlongationBlock;
    struct Motions;

    void
    aggregate_nodes();
    void
    set_up_pattern();
    void
    copy_matrix(const BlockMatrix &A);
    void
    estimate_largest_eigenvalue();
    void
    build_coarse(const BlockMatrix &A, const double *positions);
    Motions
    rigid_motions(const std::vector<double> &positions) const;
    void
    smooth_motions(std::vector<ProlongationBlock> &prolongation,
                   const BlockMatrix              &A,
                   const Motions                  &motions,
                   const std::vector<double>      &positions);
    void
    fill_coarse(const BlockMatrix                    &A,
                const std::vector<ProlongationBlock> &prolongation);

    void
    apply(float *y, float *x) const;
    void
    smooth(float *x, const float *b, const bool x_is_zero) const;
    void
    correct(float *x, const float *residual) const;
    void
    cycle(float *x, const float *b) const;

    const unsigned int degree;
    double             least_strength = 0;

    /// That of A; none is none.
    std::shared_ptr<const BlockPattern> pattern;
    int                                 n_nodes = 0;

    /// Aggregates are numbered through all ranks, rows are owned ones.
    int              first_aggregate = 0;
    std::vector<int> aggregates;
    NodeGraph        nodes_of_aggregates;
    /// With rows of ghosts.
    NodeGraph     prolongation_pattern;
    GhostExchange prolongation_ghosts;
    NodeGraph     product_pattern;
    /// Lower triangle only.
    NodeGraph coarse_pattern;
    /// Each aggregate has two nodes with three unknowns: its translations and
    /// its rotations.
    std::unique_ptr<BlockMatrix> coarse_matrix;

    /// What A is divided by, a power of two, so that single precision holds it
    /// whatever its size is.
    double unit = 1;
    /// Blocks of A / unit and inverses of its diagonal blocks, by columns.
    std::vector<float>         blocks;
    std::vector<float>         inverse_diagonal;
    std::vector<unsigned char> is_prescribed;
    double                     largest_eigenvalue = 0;
    /// 3 x 6, by rows.
    std::vector<float> prolongation_blocks;
    SparseCholesky     coarse_factor;

    /// With entries of ghosts.
    mutable std::vector<float> solution, direction;
    mutable std::vector<float> rhs, residual, product, coarse;
  };
} // namespace corotet

#endif
