// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_preconditioner_h
#define corotet_solvers_preconditioner_h

#include <corotet/base/archive.h>
#include <corotet/base/vector.h>
#include <corotet/operators/effective_operator.h>

#include <deal.II/base/parameter_handler.h>

#include <limits>
#include <string>

namespace corotet
{
  class TangentOperator;

  /**
   * An approximate inverse P of the effective operator A for conjugate
   * gradients, symmetric and positive definite. The exact inverse is allowed,
   * too.
   */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
    {}

    /**
     * Makes P from A as it is now. @p displacement is the current one of the
     * nodes [m], from which rigid body modes are made. A must live as long as P
     * is used; when it changes, P remains that of the older A. Collective.
     */
    virtual void
    build(const EffectiveOperator &A, const Vector &displacement) = 0;

    /// Makes P for solves with the operator @p J, which is close to A; null if
    /// it is A itself. P may be made of J if that is definite.
    virtual void
    build_for(const EffectiveOperator &A,
              const TangentOperator * /*J*/,
              const Vector &displacement)
    {
      build(A, displacement);
    }

    /// Takes over the changes of A as far as that is cheap. Collective.
    virtual void
    update(const EffectiveOperator & /*A*/)
    {}

    /// dst = P src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// The same, given the norm of @p src, which may save a sum over the ranks.
    /// Collective.
    virtual void
    vmult_with_norm(Vector       &dst,
                    const Vector &src,
                    const double /*src_norm*/) const
    {
      vmult(dst, src);
    }

    /// The cost of an iteration, relative to one with a preconditioner that is
    /// about as cheap as the operator, if it is far more than that.
    virtual double
    cost() const
    {
      return 1;
    }

    /// Number of iterations of a solve after which change() is to be called.
    /// @p is_new tells that P was built for this solve, @p is_tangent that the
    /// solve is with J.
    virtual unsigned int
    patience(const bool /*is_new*/, const bool /*is_tangent*/) const
    {
      return std::numeric_limits<unsigned int>::max();
    }

    /// Looks for a better P for the same A and J, as a solve has taken
    /// @p n_iterations, as many as patience() returns, and would take about
    /// @p n_expected in all. Afterwards patience() must be larger. Returns
    /// whether P has changed. Collective.
    virtual bool
    change(const EffectiveOperator & /*A*/,
           const TangentOperator * /*J*/,
           const Vector & /*displacement*/,
           const unsigned int /*n_iterations*/,
           const double /*n_expected*/)
    {
      return false;
    }

    /// Called after each solve that has ended, with whether P was built for it.
    /// Returns whether P is to be built anew before the next one.
    virtual bool
    take_note(const unsigned int /*n_iterations*/, const bool /*was_built*/)
    {
      return false;
    }

    /// Lines for the log about decisions since the last call; empty if there
    /// were none.
    virtual std::string
    take_news()
    {
      return {};
    }

    /// Transfers the data that later decisions depend on.
    virtual void
    transfer(Archive & /*archive*/)
    {}

    /// Whether P is to be built anew after a solve with that many iterations,
    /// even if it was the first one with this P: one for the next operator may
    /// fit better.
    virtual bool
    is_worth_another(const unsigned int /*n_iterations*/) const
    {
      return false;
    }

    /// The cost of build() in iterations of a solve: P is outdated as soon as
    /// the solves since the last build() have taken so many iterations more,
    /// all together, than if each had taken as many as the first one.
    virtual double
    build_cost() const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Number of iterations that a solve may take before P counts as outdated,
    /// given that of the first solve after it was built.
    virtual unsigned int
    acceptable_iterations(const unsigned int first) const
    {
      return first + first / 2 + 3;
    }
  };
} // namespace corotet

#endif
