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
   * gradients: symmetric and positive definite. The exact inverse is one too.
   */
  class Preconditioner
  {
  public:
    virtual ~Preconditioner() = default;

    virtual void
    declare_parameters(dealii::ParameterHandler & /*prm*/)
    {}

    /**
     * Makes P from A as it is now. @p displacement is the current one of
     * the nodes [m], from which rigid body modes are made. A must live as long
     * as P is used; when it changes, P is that of an older A. Collective.
     */
    virtual void
    build(const EffectiveOperator &A, const Vector &displacement) = 0;

    /// The same for solves with the operator @p J, which is close to A; null if
    /// it is A. P may be made of J, if that is definite.
    virtual void
    build_for(const EffectiveOperator &A,
              const TangentOperator * /*J*/,
              const Vector &displacement)
    {
      build(A, displacement);
    }

    /// Takes over a new A as far as that is cheap. Collective.
    virtual void
    update(const EffectiveOperator & /*A*/)
    {}

    /// dst = P src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

    /// The same where the norm of @p src is known, which may save a sum over
    /// the ranks. Collective.
    virtual void
    vmult_with_norm(Vector       &dst,
                    const Vector &src,
                    const double /*src_norm*/) const
    {
      vmult(dst, src);
    }

    /// What an iteration takes, where that is far more than the operator's
    /// application: in iterations of a preconditioner that is as cheap.
    virtual double
    cost() const
    {
      return 1;
    }

    /// Iterations of a solve after which change() is to be called; @p is_new:
    /// P was built for this solve; @p is_tangent: it is one with J.
    virtual unsigned int
    patience(const bool /*is_new*/, const bool /*is_tangent*/) const
    {
      return std::numeric_limits<unsigned int>::max();
    }

    /// Looks for a better P of the same A and J, as a solve has taken
    /// @p n_iterations, as many as patience() says: afterwards that is longer.
    /// It would take @p n_expected in all as it goes.
    /// Returns whether P is another one now. Collective.
    virtual bool
    change(const EffectiveOperator & /*A*/,
           const TangentOperator * /*J*/,
           const Vector & /*displacement*/,
           const unsigned int /*n_iterations*/,
           const double /*n_expected*/)
    {
      return false;
    }

    /// Hears of each solve that has come to its end, and whether P was built
    /// for it. Returns whether P is to be built anew before the next one.
    virtual bool
    take_note(const unsigned int /*n_iterations*/, const bool /*was_built*/)
    {
      return false;
    }

    /// Lines for the log on what has been decided since the last call; empty if
    /// there is nothing new.
    virtual std::string
    take_news()
    {
      return {};
    }

    /// What later decisions depend on.
    virtual void
    transfer(Archive & /*archive*/)
    {}

    /// Whether P, with which a solve has taken so many iterations, is to be
    /// built anew even if that one was the first with it: the next operator may
    /// fit better.
    virtual bool
    is_worth_another(const unsigned int /*n_iterations*/) const
    {
      return false;
    }

    /// What build() takes, in iterations of a solve: as soon as the solves
    /// since the last one have taken so many more, all together, than if each
    /// had taken as many as the first, P is outdated.
    virtual double
    build_cost() const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// Iterations that a solve may take before P counts as outdated,
    /// given those of the first solve after it was built.
    virtual unsigned int
    acceptable_iterations(const unsigned int first) const
    {
      return first + first / 2 + 3;
    }
  };
} // namespace corotet

#endif
