// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_surface_forces_h
#define corotet_forces_surface_forces_h

#include <corotet/forces/traction.h>

#include <string>

namespace corotet
{
  /**
   * Section Loads, entry Surface forces: a force [N] spread evenly over a
   * surface at rest, on one of the boundaries that the surface consists of.
   */
  class EvenTraction : public Traction
  {
  public:
    /// @p force is that of the whole surface, whose area at rest is @p area
    /// [m^2].
    EvenTraction(const Discretization   &discretization,
                 const ReferenceElement &reference,
                 const unsigned int      boundary,
                 const Expression       &force,
                 const double            area)
      : Traction(discretization, reference, boundary, force)
      , area(area)
    {}

  protected:
    void
    integrate(Vector &f, const Field &force) const override;

  private:
    double area;
  };

  class SurfaceForcesKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    std::string forces;
  };
} // namespace corotet

#endif
