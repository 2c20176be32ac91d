// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/point_stress.h>

namespace corotet
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  PointStress::PointStress(
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const std::shared_ptr<const MaterialLaw>        &law)
    : discretization(discretization)
    , centre(reference.centre)
    , law(law)
  {
    for (const auto &[region, material] : materials)
      material_of_region[region] = index_of(material, this->materials);
  }

  void
  PointStress::evaluate(const Vector                        &u,
                        const unsigned int                   cell,
                        const ReferenceElement::PointValues &rule,
                        SymmetricTensor<2, 3>               *stresses) const
  {
    std::vector<Tensor<2, 3>> gradients(rule.weights.size());
    for (unsigned int q = 0; q < gradients.size(); ++q)
      gradients[q] = displacement_gradient(discretization, u, cell, rule, q);
    const Tensor<2, 3> at_centre =
      law->has_cell_rotation() ?
        displacement_gradient(discretization, u, cell, centre, 0) :
        Tensor<2, 3>();
    law->spatial_stresses(materials[material_index(cell)],
                          at_centre,
                          gradients,
                          stresses);
  }
} // namespace corotet
