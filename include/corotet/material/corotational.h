// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_corotational_h
#define corotet_material_corotational_h

#include <corotet/material/isotropic.h>

#include <deal.II/base/tensor.h>

namespace corotet
{
  /**
   * Strain of corotational elasticity, sym(R^T F) - I with F = I + grad u, as
   * seen in the frame that rotates with the cell [seed, 2.1.2.4]. With R = I it
   * is the strain of linear elasticity, without loss of digits.
   */
  inline dealii::SymmetricTensor<2, 3>
  corotational_strain(const dealii::Tensor<2, 3> &grad_u,
                      const dealii::Tensor<2, 3> &R)
  {
    dealii::Tensor<2, 3> A = transpose(R) * grad_u;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        A[a][b] += R[b][a] - (a == b ? 1. : 0.);
    return symmetrize(A);
  }

  /**
   * First Piola-Kirchhoff stress P = R sigma of corotational elasticity [Pa].
   */
  inline dealii::Tensor<2, 3>
  corotational_stress(const IsotropicMaterial    &material,
                      const dealii::Tensor<2, 3> &grad_u,
                      const dealii::Tensor<2, 3> &R)
  {
    return R * dealii::Tensor<2, 3>(
                 stress(material, corotational_strain(grad_u, R)));
  }

  /**
   * Derivative of that stress by grad u in the direction @p grad_v, with the
   * rotation frozen.
   */
  inline dealii::Tensor<2, 3>
  corotational_tangent(const IsotropicMaterial    &material,
                       const dealii::Tensor<2, 3> &grad_v,
                       const dealii::Tensor<2, 3> &R)
  {
    return R * dealii::Tensor<2, 3>(
                 stress(material, symmetrize(transpose(R) * grad_v)));
  }

  /**
   * Angle of a rotation [rad], in [0, pi].
   */
  inline double
  rotation_angle(const dealii::Tensor<2, 3> &R)
  {
    // The sine determines the angle where the cosine is flat, and vice versa.
    const double sine =
      0.5 * std::hypot(R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]);
    return std::atan2(sine, 0.5 * (trace(R) - 1));
  }
} // namespace corotet

#endif
