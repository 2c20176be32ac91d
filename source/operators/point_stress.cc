// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/polar_decomposition.h>
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

    Tensor<2, 3>
    rotation_of(const Tensor<2, 3> &grad_u)
    {
      return polar_decomposition(
               grad_u + Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
        .rotation;
    }
  } // namespace

  PointStress::PointStress(
    const Discretization                            &discretization,
    const ReferenceElement                          &reference,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const Rotation                                   rotation)
    : discretization(discretization)
    , centre(reference.centre)
    , rotation(rotation)
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
    const IsotropicMaterial &law = materials[material_index(cell)];
    Tensor<2, 3>             R(dealii::unit_symmetric_tensor<3>());
    if (rotation == Rotation::cell_centre ||
        rotation == Rotation::cell_centre_variational)
      R =
        rotation_of(displacement_gradient(discretization, u, cell, centre, 0));
    for (unsigned int q = 0; q < rule.weights.size(); ++q)
      {
        const Tensor<2, 3> grad_u =
          displacement_gradient(discretization, u, cell, rule, q);
        if (rotation == Rotation::quadrature_points)
          R = rotation_of(grad_u);
        const SymmetricTensor<2, 3> sigma =
          stress(law, corotational_strain(grad_u, R));
        stresses[q] = rotation == Rotation::none ?
                        sigma :
                        symmetrize(R * Tensor<2, 3>(sigma) * transpose(R));
      }
  }
} // namespace corotet
