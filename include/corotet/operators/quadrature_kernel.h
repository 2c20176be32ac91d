// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_quadrature_kernel_h
#define corotet_operators_quadrature_kernel_h

#include <corotet/discretization/reference_element.h>
#include <corotet/material/corotational_simd.h>
#include <corotet/operators/cell_rule.h>
#include <corotet/operators/derivative_form.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/rotated_frame.h>
#include <corotet/operators/sweep.h>

namespace corotet
{
  /**
   * Integrals over batch_size cells by quadrature: for laws that the factored
   * kernel cannot integrate, for all that varies inside a cell, and for curved
   * cells. Nodal values are arrays [node][component], one cell per lane. A Rule
   * is one of cell_rule.h.
   */
  template <int n>
  class QuadratureKernel
  {
  public:
    using V = Simd<double>;

    static constexpr int n_nodes = n;

    using NodalValues = V[n_nodes][3];
    using Tensor2     = V[3][3];
    /// Gradients of the reference coordinates, for curved cells those at the
    /// centre, [3 (k - 1) + component].
    using Geometry = V[9];

    /// Loads the geometry at rest and @p displacement, minus that of the first
    /// node.
    static COROTET_ALWAYS_INLINE void
    load(const ElasticData &data,
         const unsigned int batch,
         const double      *displacement,
         Geometry          &g,
         NodalValues       &u)
    {
      gather_differences<n_nodes>(data.batches, batch, displacement, u);
      load_at_rest(data, batch, g);
    }

    /// grad u at point @p q of @p rule: row a is the gradient of component a.
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    gradient(const Rule        &rule,
             const unsigned int q,
             const Geometry    &g,
             const NodalValues &u,
             Tensor2           &result)
    {
      V derivatives[9];
      derivatives_of<n>(derivatives_at(rule, q), u, derivatives);
      from_reference(rule, q, g, derivatives, result);
    }

    /// f_i += P grad N_i at point @p q of @p rule.
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    add(const Rule        &rule,
        const unsigned int q,
        const Geometry    &g,
        const Tensor2     &P,
        NodalValues       &f)
    {
      V derivatives[9];
      to_reference(rule, q, g, P, derivatives);
      add_transposed<n>(derivatives_at(rule, q), derivatives, f);
    }

    /// Calls @p function(q, grad u) for all points of @p rule.
    template <typename Rule, typename Function>
    static COROTET_ALWAYS_INLINE void
    for_each_point(const Rule        &rule,
                   const Geometry    &g,
                   const NodalValues &u,
                   const Function    &function)
    {
      V derivatives[Form::max_points][9];
      derivatives_at_points(rule, g, u, derivatives);
      for (unsigned int q = 0; q < n_points(rule); ++q)
        {
          Tensor2 grad_u;
          to_gradient(rule, q, g, derivatives[q], grad_u);
          function(q, grad_u);
        }
    }

    /**
     * f_i += integral of P(grad u) grad N_i. @p stress(q, grad u, P) computes
     * the first Piola-Kirchhoff stress at point q of @p rule.
     */
    template <typename Rule, typename Stress>
    static COROTET_ALWAYS_INLINE void
    integrate(const Rule        &rule,
              const Geometry    &g,
              const V            volume,
              const NodalValues &u,
              NodalValues       &f,
              const Stress      &stress)
    {
      V derivatives[Form::max_points][9];
      derivatives_at_points(rule, g, u, derivatives);
      for (unsigned int q = 0; q < n_points(rule); ++q)
        {
          Tensor2 grad_u, P;
          to_gradient(rule, q, g, derivatives[q], grad_u);
          stress(q, grad_u, P);
          if constexpr (transforms_coefficients<Rule>)
            static_for<9>(
              [&](auto ab) { derivatives[q][ab] = P[ab / 3][ab % 3]; });
          else
            {
              const V weight = weight_at(rule, q) * volume;
              static_for<9>([&](auto ab) { P[ab / 3][ab % 3] *= weight; });
              to_reference(rule, q, g, P, derivatives[q]);
            }
        }
      typename Form::Coefficients sums;
      Form::template sum_up<transforms_coefficients<Rule>>(rule,
                                                           derivatives,
                                                           sums);
      if constexpr (transforms_coefficients<Rule>)
        {
          Geometry scaled;
          static_for<9>([&](auto i) { scaled[i] = volume * g[i]; });
          static_for<Form::n_polynomials>([&](auto i) {
            Tensor2 P;
            static_for<9>([&](auto ab) { P[ab / 3][ab % 3] = sums[i][ab]; });
            to_reference(rule, 0, scaled, P, sums[i]);
          });
        }
      Form::add_to_nodes(sums, f);
    }

  private:
    using Form = DerivativeForm<n>;

    /// Whether all points have the same gradients of the coordinates. These are
    /// then multiplied with coefficients instead of values at points: at degree
    /// 3 there are 10 and 14 of them.
    template <typename Rule>
    static constexpr bool transforms_coefficients =
      Form::has_coefficients && is_of_straight_cells<Rule>;

    /// Derivatives at the points: gradients if coefficients are transformed.
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    derivatives_at_points(const Rule        &rule,
                          const Geometry    &g,
                          const NodalValues &u,
                          V (&derivatives)[Form::max_points][9])
    {
      typename Form::Coefficients c;
      Form::from_nodes(u, c);
      if constexpr (transforms_coefficients<Rule>)
        static_for<Form::n_polynomials>([&](auto i) {
          Tensor2 gradient;
          from_reference(rule, 0, g, c[i], gradient);
          static_for<9>([&](auto ab) { c[i][ab] = gradient[ab / 3][ab % 3]; });
        });
      Form::evaluate(rule, c, derivatives);
    }

    /// The gradient from the result of derivatives_at_points() for point @p q.
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    to_gradient(const Rule        &rule,
                const unsigned int q,
                const Geometry    &g,
                const V (&derivatives)[9],
                Tensor2 &gradient)
    {
      if constexpr (transforms_coefficients<Rule>)
        static_for<9>(
          [&](auto ab) { gradient[ab / 3][ab % 3] = derivatives[ab]; });
      else
        from_reference(rule, q, g, derivatives, gradient);
    }

    /// Computes the gradient from derivatives by the reference coordinates.
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    from_reference(const Rule        &rule,
                   const unsigned int q,
                   const Geometry    &g,
                   const V (&derivatives)[9],
                   Tensor2 &gradient)
    {
      Tensor2 by_xi;
      static_for<9>([&](auto ak) { by_xi[ak / 3][ak % 3] = derivatives[ak]; });
      to_centre(rule, q, by_xi);
      static_for<9>([&](auto ab) {
        V sum{};
        static_for<3>(
          [&](auto k) { sum += by_xi[ab / 3][k] * g[3 * k + ab % 3]; });
        gradient[ab / 3][ab % 3] = sum;
      });
    }

    /// The transpose of from_reference().
    template <typename Rule>
    static COROTET_ALWAYS_INLINE void
    to_reference(const Rule        &rule,
                 const unsigned int q,
                 const Geometry    &g,
                 const Tensor2     &P,
                 V (&derivatives)[9])
    {
      Tensor2 by_xi;
      static_for<9>([&](auto ak) {
        V sum{};
        static_for<3>(
          [&](auto b) { sum += P[ak / 3][b] * g[3 * (ak % 3) + b]; });
        by_xi[ak / 3][ak % 3] = sum;
      });
      from_centre(rule, q, by_xi);
      static_for<9>([&](auto ak) { derivatives[ak] = by_xi[ak / 3][ak % 3]; });
    }
  };
} // namespace corotet

#endif
