// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/point_stress.h>

namespace corotet
{
  using dealii::SymmetricTensor;
  using dealii::Tensor;

  namespace
  {
    // grad u at point q of a rule. Values relative to the first node: a common
    // translation costs no digits.
    Tensor<2, 3>
    displacement_gradient(const Discretization                &discretization,
                          const Vector                        &u,
                          const unsigned int                   cell,
                          const ReferenceElement::PointValues &rule,
                          const unsigned int                   q)
    {
      const auto   nodes = discretization.cell_nodes(cell);
      Tensor<2, 3> by_xi;
      for (unsigned int i = 1; i < nodes.size(); ++i)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double difference = u.local_element(3 * nodes[i] + a) -
                                      u.local_element(3 * nodes[0] + a);
            for (unsigned int k = 0; k < 3; ++k)
              by_xi[a][k] += difference * rule.gradients(q, i, k);
          }
      return by_xi *
             point_geometry(discretization, rule, cell, q).inverse_jacobian;
    }
  } // namespace

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
      {
        unsigned int index = 0;
        while (index < this->materials.size() &&
               (this->materials[index].lambda != material.lambda ||
                this->materials[index].mu != material.mu))
          ++index;
        if (index == this->materials.size())
          this->materials.push_back(material);
        material_of_region[region] = index;
      }
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
