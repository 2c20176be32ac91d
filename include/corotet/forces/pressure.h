// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_pressure_h
#define corotet_forces_pressure_h

#include <corotet/forces/force_kind.h>

#include <array>
#include <vector>

namespace corotet
{
  /**
   * Section Boundary conditions, entry Pressure [Pa], positive into the body:
   * on the deformed surface, which it follows, or, with linear elasticity, on
   * the surface at rest.
   */
  class Pressure : public ForceTerm
  {
  public:
    /// @p discretization, @p reference and @p load must outlive this object.
    Pressure(const Discretization                  &discretization,
             const ReferenceElement                &reference,
             const BoundaryConditions::SurfaceLoad &load,
             const bool                             follow);

    bool
    depends_on_time() const override
    {
      return load.value.depends_on_time();
    }

    bool
    depends_on_displacement() const override
    {
      return follow;
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

    bool
    has_linearization() const override
    {
      return follow;
    }

    void
    linearize(const Motion &motion) override;

    void
    add_linearized(Vector       &f,
                   const Vector &w,
                   const double  velocity_factor) const override;

    bool
    is_symmetric() const override
    {
      return !follow;
    }

    bool
    has_potential() const override
    {
      return !follow;
    }

    /// Relative to the size of all loads: displacements are known to some eps
    /// |u|, directions of faces to that over their height.
    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const override;

  private:
    /// A point of the surface.
    struct PressurePoint
    {
      const BoundaryFace *face;
      /// In the face's rule.
      unsigned int index;
      /// Pressure times weight [Pa].
      double pressure;
      /// Derivatives of the position by the face's parameters [m].
      std::array<dealii::Tensor<1, 3>, 2> tangents;
    };

    /// Calls @p function(face, point) for the points of the surface, moved by
    /// @p u if that is not null.
    template <typename Function>
    void
    for_each_point(const Vector *u, const Function &function) const;

    const Discretization                  &discretization;
    const ReferenceElement                &reference;
    const BoundaryConditions::SurfaceLoad &load;
    const bool                             follow;
    /// Of the faces, the inverse of the smallest height [1/m].
    double inverse_height = 0;
    /// Of the last linearize().
    std::vector<PressurePoint> points;
  };

  /**
   * The boundary conditions have its parameters.
   */
  class PressureKind : public ForceKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;
  };
} // namespace corotet

#endif
