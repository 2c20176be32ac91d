// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_gravity_h
#define corotet_forces_gravity_h

#include <corotet/forces/dead_load.h>

namespace corotet
{
  /**
   * Section Loads, entry Gravity: an acceleration field [m/s^2], interpolated
   * at the nodes, times the mass matrix. So a free body falls without
   * deforming, whatever the mass matrix.
   */
  class Gravity : public DeadLoad
  {
  public:
    /// The arguments must outlive this object.
    Gravity(const Discretization &discretization,
            const Mass           &mass,
            const Expression     &acceleration);

  protected:
    void
    integrate(Vector &f, const Field &acceleration) const override;

  private:
    const Mass &mass;
  };

  class GravityKind : public VectorFieldKind
  {
  public:
    GravityKind();

    std::vector<GivenEntry>
    given() const override;

  protected:
    std::unique_ptr<ForceTerm>
    make(const Expression &value, const ForceContext &context) const override;
  };
} // namespace corotet

#endif
