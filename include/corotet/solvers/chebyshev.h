// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_chebyshev_h
#define corotet_solvers_chebyshev_h

#include <corotet/operators/cellwise_operator.h>

namespace corotet
{
  /**
   * Chebyshev iteration with the point diagonal D as smoother (Adams, Brezina,
   * Hu, Tuminaro 2003): it damps the eigenvectors of D^{-1} A whose eigenvalues
   * lie between the largest one and a fraction of it. Each step is one sweep
   * over the cells.
   *
   * Where a matrix of the surface couples the unknowns of a node, D has these
   * couplings, too: springs along a normal that is not an axis are stiff in one
   * direction only, which a point diagonal does not see.
   *
   * @p A must outlive this object.
   */
  class Chebyshev
  {
  public:
    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

    /// @p degree is the number of steps, @p range the ratio of the largest to
    /// the smallest eigenvalue to damp.
    Chebyshev(const CellwiseOperator<float> &A,
              const unsigned int             degree,
              const double                   range);

    /// Takes the diagonal of A without @p surface, with zero for prescribed
    /// unknowns, and that of @p surface with its couplings, if it is not null.
    /// Collective.
    void
    update_diagonal(const FloatVector            &diagonal,
                    const SurfaceOperator<float> *surface = nullptr);

    /// Estimates the largest eigenvalue of D^{-1} A by some Lanczos steps from
    /// D^{-1/2} times @p start, which must have no pattern. Collective.
    void
    estimate_eigenvalues(const FloatVector &start);

    /// The last estimate, some percent above the largest Ritz value.
    double
    largest_eigenvalue() const
    {
      return max_eigenvalue;
    }

    /// Smooths A x = b from x = 0; collective.
    void
    smooth_from_zero(FloatVector &x, const FloatVector &b) const;

    /// Smooths A x = b; x is zero at prescribed unknowns. Collective.
    void
    smooth(FloatVector &x, const FloatVector &b) const;

  private:
    /// D at a node with couplings, and its inverse on the unknowns that are not
    /// prescribed.
    struct NodeBlock
    {
      unsigned int         node;
      dealii::Tensor<2, 3> D, inverse;
    };

    void
    find_blocks(const FloatVector            &diagonal,
                const SurfaceOperator<float> &surface);
    /// y = D^{-1} x; y and x must be different vectors.
    void
    scale(FloatVector &y, const FloatVector &x) const;
    /// The square root of x . D x without prescribed unknowns. Collective.
    double
    norm(const FloatVector &x) const;
    /// Makes one step as CellwiseOperator::chebyshev_step() does.
    void
    make_step(FloatVector       &x,
              const FloatVector &b,
              const float        beta,
              const float        alpha) const;
    void
    remaining_steps(FloatVector &x, const FloatVector &b) const;

    const CellwiseOperator<float> &A;
    unsigned int                   degree;
    double                         range;
    double                         max_eigenvalue = 1;
    FloatVector                    inverse_diagonal;
    mutable FloatVector            step;
    std::vector<NodeBlock>         blocks;
    /// Work space, used if there are blocks.
    mutable FloatVector residual, scaled_residual;
  };
} // namespace corotet

#endif
