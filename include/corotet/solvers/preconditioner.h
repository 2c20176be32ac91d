// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_preconditioner_h
#define corotet_solvers_preconditioner_h

#include <corotet/base/vector.h>
#include <corotet/operators/effective_operator.h>

#include <deal.II/base/parameter_handler.h>

namespace corotet
{
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
     * Makes P from A as it is now. @p positions are the current positions of
     * the nodes [m], from which rigid body modes are made. A must live as long
     * as P is used; when it changes, P is that of an older A. Collective.
     */
    virtual void
    build(const EffectiveOperator &A, const Vector &positions) = 0;

    /// Takes over a new A as far as that is cheap. Collective.
    virtual void
    update(const EffectiveOperator & /*A*/)
    {}

    /// dst = P src. Collective.
    virtual void
    vmult(Vector &dst, const Vector &src) const = 0;

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
