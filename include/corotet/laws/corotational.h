// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_corotational_h
#define corotet_laws_corotational_h

#include <corotet/laws/law_kind.h>

namespace corotet
{
  /**
   * Where the rotation of corotational elasticity is taken.
   */
  enum class Rotation
  {
    /// From F at the centre of each cell. The force is R K0 (R^T x - X).
    cell_centre,
    /// The same R; the force is the gradient of the energy, so it has a term
    /// with the derivative of R.
    cell_centre_variational,
    /// From F at each quadrature point: hyperelastic. For degree 1 all three
    /// are the same.
    quadrature_points
  };

  /// P = R sigma(sym(R^T F) - I) with F = R S where the rotation is taken
  /// [seed, 2.73 to 2.76].
  std::shared_ptr<const MaterialLaw>
  corotational_law(const Rotation rotation);

  class CorotationalKind : public LawKind
  {
  public:
    bool
    has_rotations() const override
    {
      return true;
    }

    std::shared_ptr<const MaterialLaw>
    make(const std::string &rotation) const override;
  };
} // namespace corotet

#endif
