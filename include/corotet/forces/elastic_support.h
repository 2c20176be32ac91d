// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_elastic_support_h
#define corotet_forces_elastic_support_h

#include <corotet/forces/force_kind.h>
#include <corotet/operators/surface_matrix.h>

namespace corotet
{
  /**
   * A stiffness [N/m^3] or damping [N s/m^3] per area at rest on a boundary, a
   * symmetric tensor D(x, t), as the matrix int N_i N_j D of the surface. It is
   * integrated with the rule for faces, exactly on straight faces for D linear
   * in x.
   */
  class SurfaceCoefficient
  {
  public:
    enum class Direction
    {
      /// Three expressions, for the directions x, y and z.
      axes,
      /// One expression, for the direction of the surface's normal at rest.
      normal
    };

    /// @p text has expressions in x, y, z, t, and is given by @p entry. Throws
    /// InputError, also if the values at the start are negative or not finite.
    /// Collective.
    SurfaceCoefficient(const ForceContext &context,
                       const unsigned int  boundary,
                       const std::string  &text,
                       const Direction     direction,
                       const std::string  &entry);

    bool
    depends_on_time() const
    {
      return value.depends_on_time();
    }

    unsigned int
    boundary_id() const
    {
      return boundary;
    }

    /// Whether the coefficient is zero always and everywhere.
    bool
    is_zero() const
    {
      return value.is_zero();
    }

    /// The matrix at that time. Throws WrongValueError if values are negative
    /// or not finite. Collective.
    const SurfaceMatrix &
    matrix(const double time) const;

    const SurfaceOperator<double> &
    operator_at(const double time) const;

  private:
    /// Both of these throw InputError.
    void
    evaluate(const double time) const;
    double
    checked_value(const dealii::Point<3> &x,
                  const unsigned int      component) const;

    const Discretization           &discretization;
    const unsigned int              boundary;
    const Expression                value;
    const Direction                 direction;
    const std::string               entry;
    mutable double                  time;
    mutable SurfaceMatrix           coefficients;
    mutable SurfaceOperator<double> surface_operator;
  };

  /**
   * A force of the ground on a boundary, a coefficient times the displacement
   * or the velocity, whichever the derived class depends on: f = - D u or - D v
   * per area at rest.
   */
  class SurfaceForce : public ForceTerm
  {
  public:
    bool
    depends_on_time() const override
    {
      return coefficient.depends_on_time();
    }

    bool
    is_linear() const override
    {
      return true;
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

    std::optional<unsigned int>
    ground_boundary() const override
    {
      return coefficient.boundary_id();
    }

    bool
    has_surface_matrix() const override
    {
      return true;
    }

    void
    add_surface_matrix(SurfaceMatrix &S,
                       const Motion  &motion,
                       const double   c_u,
                       const double   c_v) const override;

    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const override;

  protected:
    explicit SurfaceForce(SurfaceCoefficient &&coefficient)
      : coefficient(std::move(coefficient))
    {}

    const SurfaceCoefficient coefficient;

  private:
    /// The vector that the coefficient multiplies.
    const Vector &
    factor(const Motion &motion) const
    {
      return depends_on_displacement() ? motion.u : motion.v;
    }
  };

  /**
   * Section Supports, entries Elastic and Elastic normal: springs between a
   * boundary and the ground, f = - k u per area at rest, or - k (n . u) n with
   * the normal n at rest.
   */
  class ElasticSupport : public SurfaceForce
  {
  public:
    explicit ElasticSupport(SurfaceCoefficient &&stiffness)
      : SurfaceForce(std::move(stiffness))
    {}

    Role
    role() const override
    {
      return Role::elastic;
    }

    bool
    depends_on_displacement() const override
    {
      return true;
    }

    double
    energy(const Motion &motion) const override;
  };

  /**
   * Section Supports, entry Dashpots: dashpots between a boundary and the
   * ground, f = - c v per area at rest.
   */
  class Dashpots : public SurfaceForce
  {
  public:
    explicit Dashpots(SurfaceCoefficient &&damping)
      : SurfaceForce(std::move(damping))
    {}

    Role
    role() const override
    {
      return Role::damping;
    }

    bool
    depends_on_velocity() const override
    {
      return true;
    }
  };

  /**
   * The parameters of section Supports.
   */
  class SupportsKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    std::string elastic, elastic_normal, dashpots;
  };
} // namespace corotet

#endif
