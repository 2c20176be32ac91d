// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_smoothed_aggregation_h
#define corotet_solvers_smoothed_aggregation_h

#include <corotet/operators/block_matrix.h>
#include <corotet/solvers/aggregation_level.h>
#include <corotet/solvers/sparse_cholesky.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * One cycle of smoothed aggregation (Vanek, Mandel, Brezina 1996) for a
   * stiffness matrix A of 3 x 3 blocks, in single precision: symmetric and
   * positive definite.
   *
   * The unknowns of a coarser level are the six rigid body motions of every
   * aggregate of points of the level above, smoothed by one step of damped
   * block Jacobi. Levels are added until the last one is small; that is solved
   * by a sparse factorisation on rank 0. The smoothers are Chebyshev
   * polynomials of D^-1 A, with D block diagonal. Levels are computed in double
   * precision; their patterns are kept while that of A is the same.
   *
   * Aggregates stay within a rank; their smoothed motions extend to others.
   */
  class SmoothedAggregation
  {
  public:
    /// @p degree is that of the smoothers.
    explicit SmoothedAggregation(const unsigned int degree = 3)
      : degree(degree)
      , finest(degree)
    {}

    /// Sets the coarsening from the next pattern on. With a least similarity,
    /// see Coarsening, D has the diagonal blocks of aggregates, else those of
    /// points. Flat and stretched cells need about 0.3: aggregates across their
    /// weak couplings would treat motions as smooth that are not. Only the
    /// finest level joins aggregates.
    void
    set_coarsening(const Coarsening &wanted)
    {
      coarsening = wanted;
    }

    /// @p positions has three coordinates per owned node [m]. Throws
    /// SingularMatrixError if A is singular. Collective.
    void
    build(const BlockMatrix &A, const double *positions);

    /// The same, but A is left without values, which takes less memory.
    void
    build(BlockMatrix &&A, const double *positions);

    /// The same for a matrix of aggregates, whose entries are near one.
    /// Collective.
    void
    build(const AggregateProblem &A);

    /// dst = P src, owned entries, for float or double. @p size is about that
    /// of src, the same on all ranks: numbers in single precision are relative
    /// to it. Only the first call allocates memory. Collective.
    template <typename Number>
    void
    vmult(Number *dst, const Number *src, const double size) const;

    /// Number of aggregates on all ranks, for each level from the second one
    /// on.
    std::vector<int>
    n_aggregates() const;

    SparseCholesky &
    factor_of_last_level()
    {
      return last_factor;
    }

    const SparseCholesky &
    factor_of_last_level() const
    {
      return last_factor;
    }

  private:
    /// @p given_up: see AggregationLevel::build().
    void
    build_from_finest(const BlockMatrix &A,
                      BlockMatrix       *given_up,
                      const double      *positions);
    /// Builds the levels below the one that has made @p problem.
    void
    build_coarser(const AggregateProblem *problem);
    template <typename Level>
    void
    cycle(const Level       &level,
          const unsigned int n_above,
          const bool         x_is_zero) const;

    const unsigned int degree;
    Coarsening         coarsening;

    /// The finest level; unused if the matrix is one of aggregates.
    AggregationLevel<3>                               finest;
    std::vector<std::unique_ptr<AggregationLevel<6>>> coarser;
    SparseCholesky last_factor{SparseCholesky::Precision::single_precision};
    /// Unknowns of the owned aggregates of the last level, six for each.
    mutable std::vector<float> last_unknowns;
    MPI_Comm                   communicator     = MPI_COMM_SELF;
    int                        n_unknowns       = 0;
    bool                       is_of_aggregates = false;
  };
} // namespace corotet

#endif
