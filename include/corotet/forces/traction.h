// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_traction_h
#define corotet_forces_traction_h

#include <corotet/forces/dead_load.h>
#include <corotet/forces/force_kind.h>

namespace corotet
{
  /**
   * Section Boundary conditions, entry Traction: a force per area at rest [Pa]
   * on a boundary.
   */
  class Traction : public DeadLoad
  {
  public:
    /// @p discretization and @p reference must outlive this object.
    Traction(const Discretization   &discretization,
             const ReferenceElement &reference,
             const unsigned int      boundary,
             const Expression       &value);
    Traction(const Discretization   &discretization,
             const ReferenceElement &reference,
             const unsigned int      boundary,
             const Value            &value,
             const bool              depends_on_time);

  protected:
    void
    integrate(Vector &f, const Field &traction) const override;

  private:
    const ReferenceElement &reference;
    unsigned int            boundary;
  };

  /**
   * The kind Traction; its parameters belong to the boundary conditions.
   */
  class TractionKind : public ForceKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;
  };
} // namespace corotet

#endif
