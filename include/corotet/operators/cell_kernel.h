// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_cell_kernel_h
#define corotet_operators_cell_kernel_h

#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/material/isotropic.h>

#include <deal.II/base/tensor.h>

#include <type_traits>

namespace corotet
{
  /**
   * Integrals over one straight-sided cell of degree p, with all sizes known to
   * the compiler. Nodal data are arrays [node][component].
   */
  template <int p>
  struct CellKernel
  {
    static constexpr unsigned int n_nodes  = (p + 1) * (p + 2) * (p + 3) / 6;
    static constexpr unsigned int n_points = p == 1 ? 1 : p == 2 ? 4 : 14;

    using NodalValues = double[n_nodes][3];

    /// Values of a vector at the nodes of a cell. @p values are its local
    /// entries, ghosts included.
    static void
    gather(const double                                *values,
           const dealii::ArrayView<const unsigned int> &nodes,
           NodalValues                                 &result)
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          result[i][a] = values[3 * nodes[i] + a];
    }

    /// Values less that of the first node: gradients do not see a translation,
    /// and without it they do not lose digits to it.
    static void
    gather_differences(const double                                *values,
                       const dealii::ArrayView<const unsigned int> &nodes,
                       NodalValues                                 &result)
    {
      const double *first = values + 3 * nodes[0];
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          result[i][a] = values[3 * nodes[i] + a] - first[a];
    }

    static void
    scatter_add(const NodalValues                           &cell_values,
                const dealii::ArrayView<const unsigned int> &nodes,
                double                                      *values)
    {
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          values[3 * nodes[i] + a] += cell_values[i][a];
    }

    /// grad u at point @p q of @p rule: row a is the gradient of component a.
    static dealii::Tensor<2, 3>
    gradient(const ReferenceElement::PointValues &rule,
             const unsigned int                   q,
             const CellGeometry                  &geometry,
             const NodalValues                   &u)
    {
      const double        *dN = &rule.gradients(q, 0, 0);
      dealii::Tensor<2, 3> by_xi;
      for (unsigned int i = 0; i < n_nodes; ++i)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int k = 0; k < 3; ++k)
            by_xi[a][k] += u[i][a] * dN[3 * i + k];
      return by_xi * geometry.inverse_jacobian;
    }

    /**
     * The cell kernel: f_i += integral of P(grad u) grad N_i. The internal
     * force and the action of its tangent differ in @p stress only, a function
     * from grad u to the first Piola-Kirchhoff stress P.
     */
    template <typename Stress>
    static void
    integrate(const ReferenceElement &reference,
              const CellGeometry     &geometry,
              const NodalValues      &u,
              NodalValues            &f,
              const Stress           &stress)
    {
      const ReferenceElement::PointValues &rule = reference.stiffness_rule;
      const dealii::Tensor<2, 3>           J_inverse_transposed =
        transpose(geometry.inverse_jacobian);
      for (unsigned int q = 0; q < n_points; ++q)
        {
          const dealii::Tensor<2, 3> P =
            stress(gradient(rule, q, geometry, u)) * J_inverse_transposed *
            (rule.weights[q] * geometry.volume);
          const double *dN = &rule.gradients(q, 0, 0);
          for (unsigned int i = 0; i < n_nodes; ++i)
            for (unsigned int a = 0; a < 3; ++a)
              f[i][a] += P[a][0] * dN[3 * i] + P[a][1] * dN[3 * i + 1] +
                         P[a][2] * dN[3 * i + 2];
        }
    }

    /**
     * The block of nodes i, j of the cell's stiffness matrix R K0 R^T. For an
     * isotropic law it is K0 with the gradients of the shape functions
     * rotated: @p gradients has the rows R grad xi_k.
     */
    static dealii::Tensor<2, 3>
    stiffness_block(const ReferenceElement     &reference,
                    const IsotropicMaterial    &material,
                    const dealii::Tensor<2, 3> &gradients,
                    const double                volume,
                    const unsigned int          i,
                    const unsigned int          j)
    {
      const double        *products = &reference.gradient_products(i, j, 0);
      dealii::Tensor<2, 3> half;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int b = 0; b < 3; ++b)
            half[k][b] += products[3 * k + l] * gradients[l][b];
      // Mean of grad N_i (x) grad N_j.
      dealii::Tensor<2, 3> D;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            D[a][b] += gradients[k][a] * half[k][b];

      const double         mu_trace = material.mu * trace(D);
      dealii::Tensor<2, 3> K;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          K[a][b] = volume * (material.lambda * D[a][b] +
                              material.mu * D[b][a] + (a == b) * mu_trace);
      return K;
    }
  };

  /**
   * Calls @p function with std::integral_constant<int, p> for a degree that is
   * known at run time only.
   */
  template <typename Function>
  void
  with_degree(const unsigned int p, const Function &function)
  {
    switch (p)
      {
        case 1:
          return function(std::integral_constant<int, 1>());
        case 2:
          return function(std::integral_constant<int, 2>());
        case 3:
          return function(std::integral_constant<int, 3>());
        default:
          Assert(false, dealii::ExcInternalError());
      }
  }
} // namespace corotet

#endif
