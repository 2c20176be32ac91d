// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_round_off_h
#define corotet_operators_force_round_off_h

#include <corotet/operators/elasticity.h>

#include <limits>
#include <vector>

namespace corotet
{
  /**
   * The round-off that elastic forces may have: residuals below it mean
   * nothing.
   *
   * Displacements are stored with a relative precision eps, so their gradient
   * has an error of some eps |u| / h: it is larger for a body that has moved
   * far compared with the size h of its cells. Corotational strain is moreover
   * a difference of numbers of size 1 and has an error of some eps wherever the
   * body is, if it has turned. These errors cause stress and forces at the
   * nodes, which are independent from cell to cell: their squares add up.
   */
  class ForceRoundOff
  {
  public:
    ForceRoundOff(const Discretization &discretization,
                  const Elasticity     &elasticity);

    /// Error of the internal force of the displacement @p u, or of K u with any
    /// of the tangents K, due to that of u [N]. Collective.
    double
    of_displacement(const Vector &u) const;

    /// Error of the internal force due to that of rotations [N]; 0 for linear
    /// laws. It is an upper bound: in bodies that have hardly turned, above all
    /// thin ones, the error may be a thousandth of it.
    double
    of_rotations() const
    {
      return by_rotations;
    }

    /// The error that round-off makes in displacements, and by the rotation of
    /// cells, where displacements and the body are of this size [m]: a bound
    /// that is never exceeded.
    static double
    error_of_displacements(const double size)
    {
      return 16 * std::numeric_limits<double>::epsilon() * size;
    }

    /// For each owned node, the square of the force that an error of
    /// displacements of 1 m makes in the cells, as in of_displacement(), and in
    /// the springs on the surface, if @p springs is their diagonal [N/m] and
    /// not null [N^2/m^2].
    std::vector<double>
    squares_of_stiffness(const Vector *springs) const;

  private:
    /// For each owned node, the sum of the squares of the forces that cells
    /// exert if the displacements of their nodes are independent of each other,
    /// 1 m each [N^2/m^2].
    std::vector<double> by_displacement;
    double              by_rotations = 0;
  };
} // namespace corotet

#endif
