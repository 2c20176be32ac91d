// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_rotation_h
#define corotet_laws_rotation_h

#include <corotet/base/enumeration.h>

namespace corotet
{
  /**
   * The place where the rotation of corotational elasticity is taken.
   */
  enum class Rotation
  {
    /// The rotation R of F at the centre of each cell. The force is R K0 (R^T x
    /// - X).
    cell_centre,
    /// The same R; the force is the gradient of the energy, so it has a term
    /// with the derivative of R.
    cell_centre_variational,
    /// The rotation of F at each quadrature point: hyperelastic. For degree 1
    /// all three are the same.
    quadrature_points
  };

  inline const Enumeration<Rotation> rotations{
    {"cell centre", Rotation::cell_centre},
    {"quadrature points", Rotation::quadrature_points},
    {"cell centre, variational", Rotation::cell_centre_variational}};
} // namespace corotet

#endif
