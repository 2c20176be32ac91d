// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/with_degree.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/quadrature_sweep.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    COROTET_ALWAYS_INLINE V
    lanes(const double *values)
    {
      return load_aligned<batch_size>(values);
    }

    // Strain sym(R^T F) - I from grad u: xx, yy, zz, yz, xz, xy.
    COROTET_ALWAYS_INLINE void
    corotational_strain(const V (&grad_u)[3][3], const V (&R)[3][3], V (&e)[6])
    {
      constexpr int pairs[6][2] = {
        {0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
      static_for<6>([&](auto s) {
        constexpr int a = pairs[s][0], b = pairs[s][1];
        e[s] = a == b ? R[a][a] - 1. : 0.5 * (R[a][b] + R[b][a]);
        static_for<3>([&](auto c) {
          e[s] += a == b ?
                    R[c][a] * grad_u[c][a] :
                    0.5 * (R[c][a] * grad_u[c][b] + R[c][b] * grad_u[c][a]);
        });
      });
    }

    COROTET_ALWAYS_INLINE V
    determinant_of_F(const V (&grad_u)[3][3])
    {
      const V a = grad_u[0][0] + 1., b = grad_u[1][1] + 1.,
              c = grad_u[2][2] + 1.;
      return a * (b * c - grad_u[1][2] * grad_u[2][1]) -
             grad_u[0][1] * (grad_u[1][0] * c - grad_u[1][2] * grad_u[2][0]) +
             grad_u[0][2] * (grad_u[1][0] * grad_u[2][1] - b * grad_u[2][0]);
    }

    template <int p>
    __attribute__((flatten)) void
    sweep_state(const ReferenceElement &reference,
                const ElasticData      &data,
                const unsigned int      first,
                const unsigned int      end,
                const double           *displacement,
                PointResults           &results)
    {
      using Kernel     = QuadratureKernel<p>;
      const auto &rule = reference.stiffness_rule;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          gather_differences<Kernel::n_nodes>(data.batches,
                                              batch,
                                              displacement,
                                              u);
          V R[3][3], grad_u[3][3];
          rotations_of(data, batch, R);
          Kernel::gradient(reference.centre, 0, shapes, u, grad_u);
          V       det_F       = determinant_of_F(grad_u), energy{};
          const V mu          = lanes(shapes.mu),
                  half_lambda = 0.5 * lanes(shapes.lambda);
          for (unsigned int q = 0; q < rule.weights.size(); ++q)
            {
              Kernel::gradient(rule, q, shapes, u, grad_u);
              const V det = determinant_of_F(grad_u);
              det_F       = det < det_F ? det : det_F;
              V e[6];
              corotational_strain(grad_u, R, e);
              const V trace = e[0] + e[1] + e[2];
              energy += rule.weights[q] *
                        (mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] +
                               2. * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5])) +
                         half_lambda * trace * trace);
            }
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            if (shapes.volume[lane] > 0)
              {
                results.energy += energy[lane] * shapes.volume[lane];
                results.min_det_F = std::min(results.min_det_F, det_F[lane]);
                results.inverted_cells += det_F[lane] < 0;
              }
        }
    }

    template <int p>
    __attribute__((flatten)) void
    sweep_tangent(const ReferenceElement &reference,
                  const ElasticData      &data,
                  const unsigned int      first,
                  const unsigned int      end,
                  const double           *source,
                  double                 *sums)
    {
      using Kernel = QuadratureKernel<p>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, f{};
          gather_batch<Kernel::n_nodes>(data.batches, batch, source, u);
          V R[3][3];
          rotations_of(data, batch, R);
          const V    mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          const auto stress =
            [&](const unsigned int, const V(&grad_u)[3][3], V(&P)[3][3]) {
              corotational_tangent(R, lambda, mu, grad_u, P);
            };
          Kernel::integrate(reference.stiffness_rule, shapes, u, f, stress);
          scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
        }
    }
  } // namespace

  StateSweep
  state_sweep(const unsigned int degree)
  {
    StateSweep result = nullptr;
    with_degree(degree, [&](const auto p) {
      result = sweep_state<decltype(p)::value>;
    });
    return result;
  }

  QuadratureSweep
  tangent_by_quadrature_sweep(const unsigned int degree)
  {
    QuadratureSweep result = nullptr;
    with_degree(degree, [&](const auto p) {
      result = sweep_tangent<decltype(p)::value>;
    });
    return result;
  }
} // namespace corotet
