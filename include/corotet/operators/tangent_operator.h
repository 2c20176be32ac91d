// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_tangent_operator_h
#define corotet_operators_tangent_operator_h

#include <corotet/operators/effective_operator.h>
#include <corotet/operators/force_terms.h>

namespace corotet
{
  /**
   * The derivative of the equation of motion by the displacement, where the
   * effective operator only approximates it: with a rotation for each
   * quadrature point, with derivatives of rotations, and with those of forces,
   *
   *   J = K_T - sum (df/du + c_v df/dv) + (c_K - 1) K_frozen + c_M M + S.
   *
   * Rows and columns of prescribed unknowns are those of a diagonal matrix.
   * The arguments of the constructor must outlive this object.
   */
  class TangentOperator
  {
  public:
    /// @p A has the cells, the mass and the prescribed unknowns. Collective.
    TangentOperator(const EffectiveOperator &A,
                    Elasticity              &elasticity,
                    ForceTerms              &forces);

    /**
     * Linearizes at that motion, to which rotations and the effective operator
     * must belong, with loads times @p load_factor, and @p velocity_factor as
     * the derivative of the velocity by the displacement [1/s]. Returns the
     * number of cells, over all ranks, where the derivative of a rotation was
     * clamped. Collective.
     */
    unsigned int
    update(const Motion &motion,
           const Tangent tangent,
           const double  load_factor,
           const double  velocity_factor);

    /// Linearizes the elasticity only, for matrix(): @p u must live until that
    /// has been called. Collective.
    unsigned int
    update_elasticity(const Vector &u, const Tangent tangent);

    /// The symmetric part of the matrix of J without the forces' share, at the
    /// motion of the last update, which must still exist. @p n_frozen times the
    /// stiffness with frozen rotations is added. The matrix takes the place of
    /// that of A. Collective.
    const BlockMatrix &
    matrix(const double n_frozen) const;

    /// Whether there is such a matrix: if the tangent is by cell, it is that of
    /// A.
    bool
    has_matrix() const
    {
      return !elasticity.is_by_cell(tangent);
    }

    /// dst = J src. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

    /// Whether the operator with that tangent differs from the effective one.
    static bool
    is_needed(const Elasticity &elasticity,
              const ForceTerms &forces,
              const Tangent     tangent)
    {
      return !elasticity.is_by_cell(tangent) ||
             forces.has_linearization(tangent);
    }

    /// Whether the last update() was for the exact tangent.
    bool
    is_exact() const
    {
      return tangent == Tangent::consistent;
    }

    /// Whether J is symmetric with that tangent; it need not be definite.
    static bool
    is_symmetric(const Elasticity &elasticity,
                 const ForceTerms &forces,
                 const Tangent     tangent)
    {
      return elasticity.is_symmetric(tangent) && forces.is_symmetric(tangent);
    }

    /// Whether J is symmetric with the tangent of the last update().
    bool
    is_symmetric() const
    {
      return is_symmetric(elasticity, forces, tangent);
    }

  private:
    const EffectiveOperator &A;
    Elasticity              &elasticity;
    ForceTerms              &forces;
    Tangent                  tangent         = Tangent::consistent;
    double                   load_factor     = 1;
    double                   velocity_factor = 0;
    const Vector            *displacement    = nullptr;
    /// Work space: the source without prescribed entries, with ghosts.
    mutable Vector source;
  };
} // namespace corotet

#endif
