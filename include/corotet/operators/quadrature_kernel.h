// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_quadrature_kernel_h
#define corotet_operators_quadrature_kernel_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/bernstein.h>
#include <corotet/operators/sweep.h>

namespace corotet
{
  /**
   * Derivative of the first Piola-Kirchhoff stress of corotational elasticity
   * [Pa] in the direction @p grad_v with the rotation @p R frozen, a cell per
   * lane: P = R (2 mu sym(A) + lambda tr(A) I) with A = R^T grad v.
   */
  COROTET_ALWAYS_INLINE void
  corotational_tangent(const Simd<double> (&R)[3][3],
                       const Simd<double> lambda,
                       const Simd<double> mu,
                       const Simd<double> (&grad_v)[3][3],
                       Simd<double> (&P)[3][3])
  {
    Simd<double> A[3][3], sigma[3][3];
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      A[a][b] = R[0][a] * grad_v[0][b] + R[1][a] * grad_v[1][b] +
                R[2][a] * grad_v[2][b];
    });
    const Simd<double> pressure = lambda * (A[0][0] + A[1][1] + A[2][2]);
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      sigma[a][b] = mu * (A[a][b] + A[b][a]);
      if constexpr (a == b)
        sigma[a][b] += pressure;
    });
    static_for<9>([&](auto ab) {
      constexpr int a = ab / 3, b = ab % 3;
      P[a][b] =
        R[a][0] * sigma[0][b] + R[a][1] * sigma[1][b] + R[a][2] * sigma[2][b];
    });
  }

  /**
   * Integrals over batch_size straight-sided cells of degree p by quadrature,
   * for laws that the factored kernel does not know: whatever varies inside a
   * cell. Nodal values are arrays [node][component], one cell per lane.
   */
  template <int p>
  class QuadratureKernel
  {
  public:
    using V = Simd<double>;

    static constexpr int n_nodes = bernstein::size<p>;

    using NodalValues = V[n_nodes][3];
    using Tensor2     = V[3][3];

    /// grad u at point @p q of @p rule: row a is the gradient of component a.
    static COROTET_ALWAYS_INLINE void
    gradient(const ReferenceElement::PointValues &rule,
             const unsigned int                   q,
             const CellShapes                    &shapes,
             const NodalValues                   &u,
             Tensor2                             &result)
    {
      const double *dN = &rule.gradients(q, 0, 0);
      Tensor2       by_xi{};
      static_for<n_nodes>([&](auto i) {
        static_for<9>([&](auto ak) {
          by_xi[ak / 3][ak % 3] += dN[3 * i + ak % 3] * u[i][ak / 3];
        });
      });
      static_for<9>([&](auto ab) {
        V sum{};
        static_for<3>([&](auto k) {
          sum += by_xi[ab / 3][k] * load_aligned<batch_size>(
                                      shapes.inverse_jacobian[3 * k + ab % 3]);
        });
        result[ab / 3][ab % 3] = sum;
      });
    }

    /**
     * f_i += integral of P(grad u) grad N_i. @p stress(q, grad u, P) computes
     * the first Piola-Kirchhoff stress at point q of @p rule.
     */
    template <typename Stress>
    static COROTET_ALWAYS_INLINE void
    integrate(const ReferenceElement::PointValues &rule,
              const CellShapes                    &shapes,
              const NodalValues                   &u,
              NodalValues                         &f,
              const Stress                        &stress)
    {
      const unsigned int n_points = rule.weights.size();
      for (unsigned int q = 0; q < n_points; ++q)
        {
          Tensor2 grad_u, P, by_xi;
          gradient(rule, q, shapes, u, grad_u);
          stress(q, grad_u, P);
          const V weight =
            rule.weights[q] * load_aligned<batch_size>(shapes.volume);
          static_for<9>([&](auto ak) {
            V sum{};
            static_for<3>([&](auto b) {
              sum +=
                P[ak / 3][b] * load_aligned<batch_size>(
                                 shapes.inverse_jacobian[3 * (ak % 3) + b]);
            });
            by_xi[ak / 3][ak % 3] = weight * sum;
          });
          const double *dN = &rule.gradients(q, 0, 0);
          static_for<n_nodes>([&](auto i) {
            static_for<9>([&](auto ak) {
              f[i][ak / 3] += dN[3 * i + ak % 3] * by_xi[ak / 3][ak % 3];
            });
          });
        }
    }
  };
} // namespace corotet

#endif
