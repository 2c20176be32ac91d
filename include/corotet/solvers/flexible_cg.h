// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_flexible_cg_h
#define corotet_solvers_flexible_cg_h

#include <corotet/base/vector.h>

#include <deal.II/lac/solver_control.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace corotet
{
  /**
   * Conjugate gradients for operators A that are nearly symmetric: each
   * direction p_j is made conjugate to the last k ones, p_i . A p_j = 0, and
   * the residual orthogonal to them (flexible conjugate gradients, Notay 2000,
   * @cite notay2000; for operators that are not symmetric, Axelsson 1987,
   * @cite axelsson1987, truncated). Where A is symmetric it does what conjugate
   * gradients do. The preconditioner, symmetric and positive definite, need not
   * be quite linear.
   *
   * It takes 2 k + 3 vectors, while GMRES takes two in each iteration.
   */
  class FlexibleCG
  {
  public:
    /// @p control must outlive this object.
    FlexibleCG(dealii::SolverControl &control, const unsigned int k)
      : control(control)
      , directions(k)
      , images(k)
      , curvatures(k)
    {}

    /**
     * Goes on from @p x until the control is content with the norm of the
     * residual. Returns whether it is; not, if a direction has no positive
     * curvature, p . A p <= 0, or if it converges so slowly that a method with
     * a longer memory should go on from @p x. Throws
     * dealii::SolverControl::NoConvergence after the control's largest number
     * of steps. Collective.
     */
    template <typename Matrix, typename Preconditioner>
    bool
    solve(const Matrix &A, Vector &x, const Vector &b, const Preconditioner &P)
    {
      Vector r(b), p(x), Ap(x);
      A.vmult(Ap, x);
      r -= Ap;
      double              residual = norm(r);
      std::vector<double> residuals;
      for (unsigned int step = 0;; ++step)
        {
          const auto state = control.check(step, residual);
          if (state == dealii::SolverControl::success)
            return true;
          if (state == dealii::SolverControl::failure)
            throw dealii::SolverControl::NoConvergence(step, residual);
          residuals.push_back(residual);
          if (is_slow(residuals))
            return false;

          P.vmult(p, r);
          A.vmult(Ap, p);
          // From the oldest on: later ones are conjugate to it already.
          const unsigned int k     = directions.size();
          const unsigned int first = step < k ? 0 : step - k;
          for (unsigned int i = first; i < step; ++i)
            {
              const double factor =
                -(directions[i % k] * Ap) / curvatures[i % k];
              p.add(factor, directions[i % k]);
              Ap.add(factor, images[i % k]);
            }
          const double curvature = p * Ap;
          if (!(curvature > 0))
            return false;
          const double length = (p * r) / curvature;
          x.add(length, p);
          residual = std::sqrt(std::max(r.add_and_dot(-length, Ap, r), 0.));
          keep(step % k, p, Ap, curvature);
        }
    }

  private:
    /// Whether, at the rate of the last ten steps, it would take more than
    /// twice the steps that are done.
    bool
    is_slow(const std::vector<double> &residuals) const
    {
      constexpr unsigned int window = 10;
      const unsigned int     n      = residuals.size();
      if (n < 3 * window / 2 || n % (window / 2) != 0)
        return false;
      const double fall =
        std::log(residuals[n - 1 - window] / residuals[n - 1]);
      const double left = std::log(residuals[n - 1] / control.tolerance());
      return !(left * window <= 2. * n * fall);
    }

    /// In place of the oldest direction, whose storage the next one takes.
    void
    keep(const unsigned int place,
         Vector            &p,
         Vector            &Ap,
         const double       curvature)
    {
      directions[place].swap(p);
      images[place].swap(Ap);
      curvatures[place] = curvature;
      if (p.size() == 0)
        {
          p.reinit(directions[place], true);
          Ap.reinit(directions[place], true);
        }
    }

    dealii::SolverControl &control;
    std::vector<Vector>    directions;
    std::vector<Vector>    images;
    std::vector<double>    curvatures;
  };
} // namespace corotet

#endif
