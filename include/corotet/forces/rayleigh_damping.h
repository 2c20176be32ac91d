// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_rayleigh_damping_h
#define corotet_forces_rayleigh_damping_h

#include <corotet/forces/force_kind.h>
#include <corotet/operators/elasticity.h>

#include <deal.II/base/parameter_handler.h>

#include <vector>

namespace corotet
{
  /// Coefficients alpha_M [1/s] and alpha_K [s] of Rayleigh damping.
  struct DampingCoefficients
  {
    double mass      = 0;
    double stiffness = 0;
  };

  /**
   * The parameters of section Damping: the coefficients, or the damping ratios
   * zeta = alpha_M / (2 omega) + alpha_K omega / 2 [-] at two frequencies
   * omega / (2 pi) [Hz], which determine them.
   */
  struct DampingParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError if coefficients and ratios are both given, or if the
    /// ratios need a negative coefficient, which would be an excitation.
    DampingCoefficients
    coefficients() const;

    DampingCoefficients given;
    std::vector<double> frequencies;
    std::vector<double> ratios;
  };

  /**
   * Rayleigh damping C v with C = alpha_M M + alpha_K K, where K turns with the
   * rotations that the material has.
   */
  class RayleighDamping : public ForceTerm
  {
  public:
    /// @p mass and @p elasticity must outlive this object; @p elasticity must
    /// have the rotations of the motion whenever forces are asked for.
    RayleighDamping(const Discretization     &discretization,
                    const Mass               &mass,
                    Elasticity               &elasticity,
                    const DampingCoefficients coefficients);

    Role
    role() const override
    {
      return Role::damping;
    }

    bool
    depends_on_time() const override
    {
      return false;
    }

    bool
    depends_on_displacement() const override
    {
      return coefficients.stiffness > 0 && !elasticity.law().is_linear();
    }

    bool
    depends_on_velocity() const override
    {
      return true;
    }

    bool
    is_linear() const override
    {
      return !depends_on_displacement();
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

    MatrixShares
    damping_shares() const override
    {
      return {coefficients.stiffness, coefficients.mass};
    }

    /// The force of a stiffness that turns with the body has no potential.
    bool
    has_potential() const override
    {
      return !depends_on_displacement();
    }

    double
    round_off(const Motion        &motion,
              const double         size,
              const ForceRoundOff &noise) const override;

  private:
    const Mass               &mass;
    Elasticity               &elasticity;
    const DampingCoefficients coefficients;
    mutable Vector            product;
  };

  class RayleighDampingKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    DampingParameters parameters;
  };
} // namespace corotet

#endif
