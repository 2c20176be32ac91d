// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_body_force_h
#define corotet_forces_body_force_h

#include <corotet/forces/dead_load.h>
#include <corotet/forces/force_kind.h>

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

  class BodyForceKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    std::string force = "0; 0; 0";
  };
} // namespace corotet

#endif
