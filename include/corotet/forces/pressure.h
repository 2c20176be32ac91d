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

    /// The error of the force, which is proportional to the size of all loads:
    /// displacements have errors of some eps |u|, directions of faces of that
    /// over their height.
    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const override;

  private:
    /// A point of the surface.
    struct PressurePoint
    {
      const BoundaryFace *face;
      /// Index of the point in the face's rule.
      unsigned int index;
      /// Half of the pressure times the point's weight [Pa].
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
    /// The inverse of the smallest height of a face [1/m].
    double inverse_height = 0;
    /// The points at the last linearize().
    std::vector<PressurePoint> points;
  };

  /**
   * The kind Pressure; its parameters belong to the boundary conditions.
   */
  class PressureKind : public ForceKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;
  };
} // namespace corotet

#endif
