// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_body_force_h
#define corotet_forces_body_force_h

#include <corotet/forces/dead_load.h>

namespace corotet
{
  /**
   * Section Loads, entry Body force: a force per volume at rest [N/m^3].
   */
  class BodyForce : public DeadLoad
  {
  public:
    /// The arguments must outlive this object.
    BodyForce(const Discretization   &discretization,
              const ReferenceElement &reference,
              const Expression       &value);
    BodyForce(const Discretization   &discretization,
              const ReferenceElement &reference,
              const Value            &value,
              const bool              depends_on_time);

  protected:
    void
    integrate(Vector &f, const Field &force) const override;

  private:
    const ReferenceElement &reference;
  };

  class BodyForceKind : public VectorFieldKind
  {
  public:
    BodyForceKind();

  protected:
    std::unique_ptr<ForceTerm>
    make(const Expression &value, const ForceContext &context) const override;
  };
} // namespace corotet

#endif
