// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_conjugate_gradients_h
#define corotet_solvers_conjugate_gradients_h

#include <corotet/base/vector.h>
#include <corotet/solvers/stop_question.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/vector_memory.h>

#include <array>
#include <cmath>

namespace corotet
{
  /**
   * The norm of r - length q, from inner products: @p rr = r . r, @p rq = r . q
   * and @p qq = q . q of all ranks, so that a step of a Krylov method needs no
   * sum of its own for it. Where it is a thousandth of r or smaller, six digits
   * are lost to cancellation, and the norm of @p next, which is that vector,
   * is taken. Collective.
   */
  inline double
  norm_after_step(const double  length,
                  const double  rr,
                  const double  rq,
                  const double  qq,
                  const Vector &next)
  {
    constexpr double smallest = 1e-6;
    const double     shift    = length * length * qq;
    const double     square   = rr - 2 * length * rq + shift;
    return square > smallest * (rr + shift) ? std::sqrt(square) : norm(next);
  }

  /// Whether @p control is content with the @p residual after @p step steps.
  /// Throws dealii::SolverControl::NoConvergence if there are to be no more.
  inline bool
  has_converged(dealii::SolverControl &control,
                const unsigned int     step,
                const double           residual)
  {
    const auto state = control.check(step, residual);
    if (state == dealii::SolverControl::failure)
      throw dealii::SolverControl::NoConvergence(step, residual);
    return state == dealii::SolverControl::success;
  }

  /**
   * Preconditioned conjugate gradients with two sums over the ranks in each
   * iteration. (deal.II's takes three; the inner products are the same ones.)
   */
  class ConjugateGradients
  {
  public:
    /// @p control and @p question, which each iteration asks, must outlive this
    /// object. @p stops_at_negative_curvature: see solve().
    ConjugateGradients(dealii::SolverControl &control,
                       const StopQuestion    &question,
                       const bool             stops_at_negative_curvature)
      : control(control)
      , question(question)
      , stops_at_negative_curvature(stops_at_negative_curvature)
    {}

    /**
     * Goes on from @p x until the control is content with the norm of the
     * residual b - A x. Returns whether it is; it is not if the method stops at
     * a direction of negative curvature, p . A p < 0, along which it has not
     * gone. Throws dealii::SolverControl::NoConvergence after the control's
     * largest number of steps, and StepInterrupted. The preconditioner @p P is
     * symmetric and positive definite. Collective.
     */
    template <typename Matrix, typename Preconditioner>
    bool
    solve(const Matrix &A, Vector &x, const Vector &b, const Preconditioner &P)
    {
      dealii::GrowingVectorMemory<Vector> memory;
      // One vector serves for z = P r and A p: z is part of p by then.
      dealii::GrowingVectorMemory<Vector>::Pointer r(memory), p(memory),
        z(memory);
      const auto &Ap = z;
      for (Vector *vector : {&*r, &*p, &*z})
        vector->reinit(x, true);
      *r = b;
      if (!x.all_zero())
        {
          A.vmult(*Ap, x);
          *r -= *Ap;
        }
      *p              = 0;
      double residual = norm(*r), slope = 1;
      for (unsigned int step = 0;; ++step)
        {
          if (has_converged(control, step, residual))
            return true;

          P.vmult_with_norm(*z, *r, residual);
          const double last_slope = slope;
          const auto own = local_inner_products<2>({{{&*r, &*z}, {&*r, &*r}}});
          std::array<double, 3> of_r{{own[0], own[1], question.share()}};
          sum_over_ranks(of_r, b.get_mpi_communicator());
          StopQuestion::obey(of_r[2]);
          slope = of_r[0];
          p->sadd(step == 0 ? 0. : slope / last_slope, 1., *z);
          A.vmult(*Ap, *p);
          const auto of_step =
            inner_products<3>({{{&*p, &*Ap}, {&*r, &*Ap}, {&*Ap, &*Ap}}});
          const double curvature = of_step[0];
          if (stops_at_negative_curvature && curvature < 0)
            return false;
          const double length = slope / curvature;
          x.add(length, *p);
          r->add(-length, *Ap);
          residual =
            norm_after_step(length, of_r[1], of_step[1], of_step[2], *r);
        }
    }

  private:
    dealii::SolverControl &control;
    const StopQuestion    &question;
    const bool             stops_at_negative_curvature;
  };
} // namespace corotet

#endif
