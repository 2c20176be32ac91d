// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_isotropic_h
#define corotet_material_isotropic_h

#include <deal.II/base/symmetric_tensor.h>

#include <map>
#include <vector>

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
   * The material with a Young's modulus [Pa] and a Poisson's ratio [-], in (-1,
   * 1/2).
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

  /// Poisson's ratio of a material [-].
  inline double
  poissons_ratio(const IsotropicMaterial &material)
  {
    return material.lambda / (2 * (material.lambda + material.mu));
  }

  /// The densities of several regions [kg/m^3].
  inline std::map<unsigned int, double>
  densities(const std::map<unsigned int, IsotropicMaterial> &materials)
  {
    std::map<unsigned int, double> result;
    for (const auto &[region, material] : materials)
      result[region] = material.density;
    return result;
  }

  /// The index among @p known materials of the one with the same elastic
  /// constants, whatever its density; if there is none, it is added to
  /// @p known.
  unsigned int
  index_of(const IsotropicMaterial        &material,
           std::vector<IsotropicMaterial> &known);

  /**
   * Stress of a small strain [Pa].
   */
  dealii::SymmetricTensor<2, 3>
  stress(const IsotropicMaterial             &material,
         const dealii::SymmetricTensor<2, 3> &strain);

  /**
   * Elastic energy per volume at rest [J/m^3].
   */
  double
  energy_density(const IsotropicMaterial             &material,
                 const dealii::SymmetricTensor<2, 3> &strain);

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
