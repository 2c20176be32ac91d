// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_isotropic_h
#define corotet_material_isotropic_h

#include <corotet/base/simd.h>

#include <deal.II/base/symmetric_tensor.h>

#include <map>

namespace corotet
{
  /**
   * Isotropic linear elasticity, sigma = lambda tr(eps) I + 2 mu eps.
   */
  struct IsotropicMaterial
  {
    /// Lamé's first parameter [Pa].
    double lambda = 0;
    /// Shear modulus [Pa].
    double mu = 0;
    /// Mass per volume at rest [kg/m^3].
    double density = 0;
  };

  /**
   * From Young's modulus [Pa] and Poisson's ratio [-], in (-1, 1/2).
   */
  inline IsotropicMaterial
  isotropic_material(const double youngs_modulus,
                     const double poissons_ratio,
                     const double density)
  {
    const double nu = poissons_ratio;
    return {youngs_modulus * nu / ((1 + nu) * (1 - 2 * nu)),
            youngs_modulus / (2 * (1 + nu)),
            density};
  }

  /// Those of several regions [kg/m^3].
  inline std::map<unsigned int, double>
  densities(const std::map<unsigned int, IsotropicMaterial> &materials)
  {
    std::map<unsigned int, double> result;
    for (const auto &[region, material] : materials)
      result[region] = material.density;
    return result;
  }

  /**
   * The isotropic law, sigma = 2 mu sym(A) + lambda tr(A) I, for numbers and
   * for registers of them: [a][b] gives a component of @p A and of @p sigma.
   */
  template <typename Number, typename Tensor2, typename Stress>
  COROTET_ALWAYS_INLINE void
  isotropic_stress(const Number   lambda,
                   const Number   mu,
                   const Tensor2 &A,
                   Stress        &sigma)
  {
    const Number pressure = lambda * (A[0][0] + A[1][1] + A[2][2]);
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      sigma[a][b] = mu * (A[a][b] + A[b][a]);
      if constexpr (a == b)
        sigma[a][b] += pressure;
    });
  }

  /// Its energy per volume at rest, mu sym(A) : sym(A) + lambda / 2 tr(A)^2.
  template <typename Number, typename Tensor2>
  COROTET_ALWAYS_INLINE Number
  isotropic_energy(const Number lambda, const Number mu, const Tensor2 &A)
  {
    Number square{};
    static_for<3>([&](auto row) {
      constexpr int a = row, b = (a + 1) % 3;
      const Number  shear = A[a][b] + A[b][a];
      square += A[a][a] * A[a][a] + 0.5 * (shear * shear);
    });
    const Number trace = A[0][0] + A[1][1] + A[2][2];
    return mu * square + 0.5 * lambda * (trace * trace);
  }

  /**
   * Stress of a small strain [Pa].
   */
  inline dealii::SymmetricTensor<2, 3>
  stress(const IsotropicMaterial             &material,
         const dealii::SymmetricTensor<2, 3> &strain)
  {
    dealii::SymmetricTensor<2, 3> sigma;
    isotropic_stress(material.lambda, material.mu, strain, sigma);
    return sigma;
  }

  /**
   * Elastic energy per volume at rest [J/m^3].
   */
  inline double
  energy_density(const IsotropicMaterial             &material,
                 const dealii::SymmetricTensor<2, 3> &strain)
  {
    return isotropic_energy(material.lambda, material.mu, strain);
  }

  /**
   * Von Mises' equivalent of a stress [Pa].
   */
  inline double
  von_mises(const dealii::SymmetricTensor<2, 3> &sigma)
  {
    return std::sqrt(1.5) * deviator(sigma).norm();
  }
} // namespace corotet

#endif
