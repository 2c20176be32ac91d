// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_point_stress_h
#define corotet_operators_point_stress_h

#include <corotet/base/vector.h>
#include <corotet/discretization/point_geometry.h>
#include <corotet/material/material_law.h>

#include <map>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * Stress at points of cells, as a function of the displacement.
   *
   * It is MaterialLaw::spatial_stresses(): corotational stress is rotated back
   * into space, R sigma R^T, so that its principal directions are those on the
   * displaced body. This stress differs from Cauchy's by terms of the order of
   * the strain.
   *
   * Materials are distinguished by their elastic constants: regions with equal
   * ones count as one material. @p discretization must outlive this object.
   * Members are not collective.
   */
  class PointStress
  {
  public:
    /// @p materials are given by region id.
    PointStress(const Discretization                            &discretization,
                const ReferenceElement                          &reference,
                const std::map<unsigned int, IsotropicMaterial> &materials,
                const std::shared_ptr<const MaterialLaw>        &law);

    /// Number of materials, the same on all ranks.
    unsigned int
    n_materials() const
    {
      return materials.size();
    }

    /// Number of the material of a local cell.
    unsigned int
    material_index(const unsigned int cell) const
    {
      return material_of_region.at(discretization.region(cell));
    }

    const IsotropicMaterial &
    material(const unsigned int index) const
    {
      return materials[index];
    }

    /**
     * Stress [Pa] at the points of @p rule in local cell @p cell, written to
     * @p stresses. Ghost entries of @p u must be up to date.
     */
    void
    evaluate(const Vector                        &u,
             const unsigned int                   cell,
             const ReferenceElement::PointValues &rule,
             dealii::SymmetricTensor<2, 3>       *stresses) const;

  private:
    const Discretization                &discretization;
    const ReferenceElement::PointValues  centre;
    std::shared_ptr<const MaterialLaw>   law;
    std::vector<IsotropicMaterial>       materials;
    std::map<unsigned int, unsigned int> material_of_region;
  };
} // namespace corotet

#endif
