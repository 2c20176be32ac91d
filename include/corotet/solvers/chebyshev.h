// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_chebyshev_h
#define corotet_solvers_chebyshev_h

#include <corotet/operators/matrix_free.h>

namespace corotet
{
  /**
   * Chebyshev iteration with the point diagonal D as smoother (Adams, Brezina,
   * Hu, Tuminaro 2003): it damps the eigenvectors of D^{-1} A whose eigenvalues
   * lie between the largest one and a fraction of it. Each step is one sweep
   * over the cells.
   *
   * @p A must outlive this object.
   */
  class Chebyshev
  {
  public:
    using FloatVector = dealii::LinearAlgebra::distributed::Vector<float>;

    /// @p degree: steps; @p range: largest over smallest eigenvalue to damp.
    Chebyshev(const MatrixFree<float> &A,
              const unsigned int       degree,
              const double             range);

    /// Takes the diagonal of A, with zero for prescribed unknowns. Collective.
    void
    update_diagonal(const FloatVector &diagonal);

    /// Estimates the largest eigenvalue of D^{-1} A by some Lanczos steps from
    /// D^{-1/2} times @p start, which must have no pattern. Collective.
    void
    estimate_eigenvalues(const FloatVector &start);

    /// The last estimate, some percent above.
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
    void
    remaining_steps(FloatVector &x, const FloatVector &b) const;

    const MatrixFree<float> &A;
    unsigned int             degree;
    double                   range;
    double                   max_eigenvalue = 1;
    FloatVector              inverse_diagonal;
    mutable FloatVector      step;
  };
} // namespace corotet

#endif
