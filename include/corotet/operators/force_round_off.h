// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_round_off_h
#define corotet_operators_force_round_off_h

#include <corotet/operators/elasticity.h>

#include <vector>

namespace corotet
{
  /**
   * What round-off may make of elastic forces: a residual below it means
   * nothing.
   *
   * Displacements are stored with a relative precision eps, so their gradient
   * is uncertain by some eps |u| / h: a body that has moved far compared with
   * the size h of its cells knows its strain less well. Corotational strain is
   * moreover a difference of numbers of size 1 and uncertain by some eps,
   * wherever the body is, if it has turned. A strain of that size has a stress,
   * and the stress forces at the nodes, which are independent from cell to
   * cell: their squares add up.
   */
  class ForceRoundOff
  {
  public:
    ForceRoundOff(const Discretization &discretization,
                  const Elasticity     &elasticity);

    /// Of the internal force of the displacement @p u, or of K u with any of
    /// the tangents K, for what u is known to [N]. Collective.
    double
    of_displacement(const Vector &u) const;

    /// Of the internal force, for what rotations are known to [N]; 0 for linear
    /// laws. An upper bound: bodies that have hardly turned, above all thin
    /// ones, may have a thousandth of it.
    double
    of_rotations() const
    {
      return by_rotations;
    }

  private:
    /// By owned node: sum of the squares of the forces that cells exert if the
    /// displacements of their nodes are independent of each other, 1 m each
    /// [N^2/m^2].
    std::vector<double> by_displacement;
    double              by_rotations = 0;
  };
} // namespace corotet

#endif
