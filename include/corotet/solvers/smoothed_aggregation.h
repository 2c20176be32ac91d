// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_smoothed_aggregation_h
#define corotet_solvers_smoothed_aggregation_h

#include <corotet/solvers/cholmod_factor.h>
#include <corotet/solvers/node_graph.h>

#include <Epetra_CrsMatrix.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * One cycle of smoothed aggregation (Vanek, Mandel, Brezina 1996) with two
   * levels for a stiffness matrix A of 3 x 3 blocks on one rank, in single
   * precision: symmetric and positive definite.
   *
   * The coarse unknowns are the six rigid body motions of every aggregate of
   * nodes, smoothed by one step of damped block Jacobi; they are found by a
   * sparse factorisation. The smoother is Chebyshev's polynomial of D^-1 A, D
   * the diagonal blocks. What the coarse level is made of is computed in double
   * precision; patterns are kept while the graph of A is the same.
   */
  class SmoothedAggregation
  {
  public:
    /// @p degree of the smoother. @p threshold: couplings |A_ij| below it times
    /// sqrt(|A_ii| |A_jj|) are ignored when nodes are aggregated [-].
    explicit SmoothedAggregation(const unsigned int degree    = 3,
                                 const double       threshold = 0);

    /// @p positions: three coordinates per node [m]. Throws ComputationError if
    /// A is singular.
    void
    build(const Epetra_CrsMatrix &A, const double *positions);

    void
    clear();

    /// dst = P src, for float or double.
    template <typename Number>
    void
    vmult(Number *dst, const Number *src) const;

    int
    n_aggregates() const
    {
      return coarse_pattern.n_rows();
    }

  private:
    /// Three rows of a block with a column per rigid motion, and two of zeros.
    struct Block;

    void
    set_up_pattern();
    void
    copy_matrix(const Epetra_CrsMatrix &A);
    void
    estimate_largest_eigenvalue();
    void
    build_coarse(const Epetra_CrsMatrix &A, const double *positions);
    void
    rigid_motions(std::vector<Block> &motions, const double *positions) const;
    void
    make_orthonormal(std::vector<Block> &motions, const int aggregate) const;
    void
    smooth_motions(std::vector<Block>       &prolongation,
                   const Epetra_CrsMatrix   &A,
                   const std::vector<Block> &motions);
    std::vector<double>
    coarse_matrix(const Epetra_CrsMatrix   &A,
                  const std::vector<Block> &prolongation) const;
    void
    factorize(const std::vector<double> &matrix);
    void
    fill_coarse(const std::vector<double> &matrix);

    void
    apply(float *y, const float *x) const;
    void
    smooth(float *x, const float *b, const bool x_is_zero) const;
    void
    correct(float *x, const float *residual) const;
    void
    cycle(float *x, const float *b) const;

    const unsigned int degree;
    const double       threshold;

    /// Keeps the graph's memory from being used by another graph.
    std::unique_ptr<Epetra_CrsGraph> graph;
    int                              n_nodes = 0;
    NodeGraph                        pattern;
    std::vector<int>                 aggregates;
    NodeGraph                        nodes_of_aggregates;
    NodeGraph                        prolongation_pattern;
    NodeGraph                        product_pattern;
    /// Lower triangle only.
    NodeGraph coarse_pattern;

    /// Blocks of A and inverses of its diagonal blocks, by columns.
    std::vector<float>         blocks;
    std::vector<float>         inverse_diagonal;
    std::vector<unsigned char> is_prescribed;
    double                     largest_eigenvalue = 0;
    /// 3 x 6, by rows.
    std::vector<float>             prolongation_blocks;
    std::unique_ptr<CholmodFactor> coarse_factor;

    mutable std::vector<float> rhs, solution, residual, product, direction;
    mutable std::vector<float> coarse;
  };
} // namespace corotet

#endif
