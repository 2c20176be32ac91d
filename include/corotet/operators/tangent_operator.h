// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_tangent_operator_h
#define corotet_operators_tangent_operator_h

#include <corotet/operators/effective_operator.h>
#include <corotet/operators/loads.h>

namespace corotet
{
  /**
   * The derivative of the equation of motion by the displacement where the
   * effective operator is not it but close to it: with a rotation for each
   * quadrature point, with derivatives of rotations, and with the derivative of
   * follower pressures,
   *
   *   J = K_T - s d f_ext / du + (c_K - 1) K_frozen + c_M M.
   *
   * Rows and columns of prescribed unknowns are those of a diagonal matrix.
   * The arguments of the constructor must outlive this object.
   */
  class TangentOperator
  {
  public:
    /// @p A shares cells, mass and prescribed unknowns. Collective.
    TangentOperator(const EffectiveOperator &A,
                    Elasticity              &elasticity,
                    Loads                   &loads);

    /**
     * Linearizes at the displacement @p u (ghosts up to date), where rotations
     * and the effective operator are up to date. The pressures are those at
     * @p time times @p load_factor. Returns in how many cells, over all ranks,
     * the derivative of a rotation was clamped. Collective.
     */
    unsigned int
    update(const Vector &u,
           const Tangent tangent,
           const double  time,
           const double  load_factor);

    /// dst = J src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// Whether J is symmetric with that tangent; it need not be definite.
    static bool
    is_symmetric(const Elasticity &elasticity,
                 const Loads      &loads,
                 const Tangent     tangent)
    {
      return elasticity.is_symmetric(tangent) && !has_pressures(loads, tangent);
    }

    /// The same for that of the last update().
    bool
    is_symmetric() const
    {
      return is_symmetric(elasticity, loads, tangent);
    }

  private:
    /// Whether the derivative of pressures is part of J.
    static bool
    has_pressures(const Loads &loads, const Tangent tangent)
    {
      return tangent == Tangent::consistent && loads.has_follower_pressure();
    }

    const EffectiveOperator  &A;
    Elasticity               &elasticity;
    Loads                    &loads;
    std::vector<unsigned int> prescribed;
    Tangent                   tangent     = Tangent::consistent;
    double                    load_factor = 1;
    /// The source without prescribed entries, with ghosts.
    mutable Vector source;
  };
} // namespace corotet

#endif
