// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_flexible_cg_h
#define corotet_solvers_flexible_cg_h

#include <corotet/base/vector.h>
#include <corotet/solvers/conjugate_gradients.h>

#include <deal.II/lac/solver_control.h>

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
   * It takes 2 k + 3 vectors, while GMRES takes two for each iteration, and two
   * sums over the ranks in each iteration.
   */
  class FlexibleCG
  {
  public:
    /// @p control and @p question, which each iteration asks, must outlive this
    /// object.
    FlexibleCG(dealii::SolverControl &control,
               const StopQuestion    &question,
               const unsigned int     k)
      : control(control)
      , question(question)
      , directions(k)
      , images(k)
      , curvatures(k)
      , crosses(std::size_t(k) * k)
    {}

    /**
     * Goes on from @p x until the control is content with the norm of the
     * residual. Returns whether it is; it is not if a direction has no positive
     * curvature, p . A p <= 0, or if the method converges so slowly that one
     * with a longer memory should go on from @p x. Throws
     * dealii::SolverControl::NoConvergence after the control's largest number
     * of steps, and StepInterrupted. Collective.
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
          if (has_converged(control, step, residual))
            return true;
          residuals.push_back(residual);
          if (is_slow(residuals))
            return false;

          P.vmult_with_norm(p, r, residual);
          A.vmult(Ap, p);
          make_conjugate(step, p, Ap);
          const auto [curvature, slope, rr, r_Ap, Ap_Ap] =
            take_products(step, p, Ap, r);
          if (!(curvature > 0))
            return false;
          const double length = slope / curvature;
          x.add(length, p);
          r.add(-length, Ap);
          residual = norm_after_step(length, rr, r_Ap, Ap_Ap, r);
          keep(step % directions.size(), p, Ap, curvature);
        }
    }

  private:
    /// Whether the method, at the rate of the last ten steps, would take more
    /// than twice the steps that are done.
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

    /// The oldest of the directions that are kept at @p step.
    unsigned int
    first(const unsigned int step) const
    {
      const unsigned int k = directions.size();
      return step < k ? 0 : step - k;
    }

    /// Makes A p orthogonal to the kept directions, beginning with the oldest:
    /// the images of later ones are orthogonal to it already, and the
    /// contribution of its own image to the products with later ones is known,
    /// so that all products are taken together.
    void
    make_conjugate(const unsigned int step, Vector &p, Vector &Ap)
    {
      const unsigned int k = directions.size(), begin = first(step);
      if (begin == step)
        return;
      sums.clear();
      for (unsigned int i = begin; i < step; ++i)
        sums.push_back(local_inner_product(directions[i % k], Ap));
      sum_over_ranks(sums, p.get_mpi_communicator());
      for (unsigned int i = begin; i < step; ++i)
        {
          const double factor = -sums[i - begin] / curvatures[i % k];
          p.add(factor, directions[i % k]);
          Ap.add(factor, images[i % k]);
          for (unsigned int j = i + 1; j < step; ++j)
            sums[j - begin] += factor * crosses[(j % k) * k + i % k];
        }
    }

    /// Inner products of p, A p and the residual r.
    struct Products
    {
      double p_Ap, p_r, r_r, r_Ap, Ap_Ap;
    };

    /// Takes the products, and stores those of p with the images of the
    /// directions that the next step keeps.
    Products
    take_products(const unsigned int step,
                  const Vector      &p,
                  const Vector      &Ap,
                  const Vector      &r)
    {
      const unsigned int k = directions.size(), begin = first(step + 1);
      const auto         own = local_inner_products<5>(
        {{{&p, &Ap}, {&p, &r}, {&r, &r}, {&r, &Ap}, {&Ap, &Ap}}});
      sums.assign(own.begin(), own.end());
      for (unsigned int i = begin; i < step; ++i)
        sums.push_back(local_inner_product(p, images[i % k]));
      sums.push_back(question.share());
      sum_over_ranks(sums, p.get_mpi_communicator());
      StopQuestion::obey(sums.back());
      for (unsigned int i = begin; i < step; ++i)
        crosses[(step % k) * k + i % k] = sums[own.size() + i - begin];
      return {sums[0], sums[1], sums[2], sums[3], sums[4]};
    }

    /// Stores p and A p in place of the oldest direction, whose memory the next
    /// one takes.
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
    const StopQuestion    &question;
    std::vector<Vector>    directions;
    std::vector<Vector>    images;
    std::vector<double>    curvatures;
    /// Entry (j, i): direction j times the image of an older direction i.
    std::vector<double> crosses;
    /// The sums over the ranks of one message.
    std::vector<double> sums;
  };
} // namespace corotet

#endif
