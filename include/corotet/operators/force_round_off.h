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
   * wherever the body is. A strain of that size has a stress, and the stress
   * forces at the nodes, which are independent from cell to cell: their squares
   * add up.
   *
   * Members are collective.
   */
  class ForceRoundOff
  {
  public:
    ForceRoundOff(const Discretization &discretization,
                  const Elasticity     &elasticity);

    /// Of the internal force of the displacement @p u [N].
    double
    of_force(const Vector &u) const;

    /// Of K v [N], for any of the tangents K.
    double
    of_product(const Vector &v) const;

  private:
    /// @p strain_noise: in machine precisions.
    double
    estimate(const Vector &u, const double strain_noise) const;

    bool has_rotations;
    /// By owned node: sum of the squares of the forces that cells exert if
    /// their strains are 1 [N^2]; empty without rotations.
    std::vector<double> by_strain;
    /// The same if the displacements of their nodes are independent of each
    /// other, 1 m each [N^2/m^2].
    std::vector<double> by_displacement;
  };
} // namespace corotet

#endif
