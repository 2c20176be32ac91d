// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/quadrature_sweep.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  namespace
  {
    using V = Simd<double>;

    // Strain sym(R^T F) - I from grad u: xx, yy, zz, yz, xz, xy.
    COROTET_ALWAYS_INLINE void
    corotational_strain(const V (&grad_u)[3][3], const V (&R)[3][3], V (&e)[6])
    {
      static_for<6>([&](auto s) {
        constexpr int a = internal::symmetric_pairs[s][0],
                      b = internal::symmetric_pairs[s][1];
        e[s]            = a == b ? R[a][a] - 1. : 0.5 * (R[a][b] + R[b][a]);
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

    // det F of cells that are exactly flat, but for round-off.
    constexpr double flat = 1e-12;

    // The rotations of F = I + grad u.
    COROTET_ALWAYS_INLINE PolarLanes
    rotations_at(const V (&grad_u)[3][3], V (&R)[3][3])
    {
      V F[3][3];
      internal::copy(grad_u, F);
      add_identity(F);
      return polar_decomposition(F, R);
    }

    template <int n_nodes, bool at_points, typename IsCurved>
    __attribute__((flatten)) void
    run_state(const IsCurved          is_curved,
              const ReferenceElement &reference,
              const ElasticData      &data,
              const unsigned int      first,
              const unsigned int      end,
              const double           *displacement,
              PointResults           &results)
    {
      using Kernel = QuadratureKernel<n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u;
          typename Kernel::Geometry    g;
          Kernel::load(data, batch, displacement, g, u);
          V R[3][3], grad_u[3][3];
          if constexpr (!at_points)
            rotations_of(data, batch, R);
          Kernel::gradient(reference.centre, 0, g, u, grad_u);
          V       det_F       = determinant_of_F(grad_u), energy{};
          const V mu          = lanes(shapes.mu),
                  half_lambda = 0.5 * lanes(shapes.lambda);
          for (unsigned int q = 0; q < n_points(rule); ++q)
            {
              Kernel::gradient(rule, q, g, u, grad_u);
              const V det = determinant_of_F(grad_u);
              det_F       = det < det_F ? det : det_F;
              if constexpr (at_points)
                rotations_at(grad_u, R);
              V e[6];
              corotational_strain(grad_u, R, e);
              const V trace = e[0] + e[1] + e[2];
              energy += weight_at(rule, q) *
                        (mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2] +
                               2. * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5])) +
                         half_lambda * trace * trace);
            }
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            if (shapes.volume[lane] > 0)
              {
                results.energy += energy[lane] * shapes.volume[lane];
                results.min_det_F = std::min(results.min_det_F, det_F[lane]);
                results.inverted_cells += det_F[lane] < -flat;
              }
        }
    }

    // f_i = sum_q w_q P(F_q) grad N_i, with the rotation of each point.
    template <int n_nodes, typename IsCurved>
    __attribute__((flatten)) void
    run_force_at_points(const IsCurved          is_curved,
                        const ReferenceElement &reference,
                        ElasticData            &data,
                        const unsigned int      first,
                        const unsigned int      end,
                        const double           *displacement,
                        double                 *sums)
    {
      using Kernel = QuadratureKernel<n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, f{};
          typename Kernel::Geometry    g;
          Kernel::load(data, batch, displacement, g, u);
          PolarLanes found;
          const V    mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          const auto stress =
            [&](const unsigned int, V(&F)[3][3], V(&P)[3][3]) {
              add_identity(F);
              V R[3][3];
              found |= polar_decomposition(F, R);
              corotational_stress(R, lambda, mu, F, P);
            };
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          Kernel::integrate(rule, g, lanes(shapes.volume), u, f, stress);
          data.counts.add(found, shapes);
          scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
        }
    }

    // Gradient of the energy with one rotation per cell. With A_q = R^T F_q,
    // dA_q = R^T dF_q - W(w) A_q, so to the force of frozen rotations comes
    // w . m with the moment m, the axial vector of sum_q w_q sigma_q A_q^T, and
    // G w = a(R^T dF) at the centre: a stress P = R W(G^{-1} m) there.
    template <int n_nodes, typename IsCurved>
    __attribute__((flatten)) void
    run_variational_force(const IsCurved          is_curved,
                          const ReferenceElement &reference,
                          ElasticData            &data,
                          const unsigned int      first,
                          const unsigned int      end,
                          const double           *displacement,
                          double                 *sums)
    {
      using Kernel = QuadratureKernel<n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, f{};
          typename Kernel::Geometry    g;
          Kernel::load(data, batch, displacement, g, u);
          V R[3][3], F[3][3];
          Kernel::gradient(reference.centre, 0, g, u, F);
          add_identity(F);
          data.counts.add(polar_decomposition(F, R), shapes);
          const V mu = lanes(shapes.mu), lambda = lanes(shapes.lambda),
                  volume = lanes(shapes.volume);
          V           moment[3]{};
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          const auto stress =
            [&](const unsigned int q, V(&F)[3][3], V(&P)[3][3]) {
              V A[3][3], sigma[3][3];
              add_identity(F);
              transposed_times(R, F, A);
              stress_of_stretch(lambda, mu, A, sigma);
              times(R, sigma, P);
              add_moment(weight_at(rule, q) * volume, sigma, A, moment);
            };
          Kernel::integrate(rule, g, volume, u, f, stress);
          V S[6], G_inverse[6], n[3], RW[3][3];
          stretch(R, F, S);
          inverse_spin_tensor(S, G_inverse);
          symmetric_times(G_inverse, moment, n);
          times_skew(R, n, RW);
          Kernel::add(reference.centre, 0, g, RW, f);
          scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
        }
    }

    template <int n_nodes, typename IsCurved>
    __attribute__((flatten)) void
    run_tangent(const IsCurved          is_curved,
                const ReferenceElement &reference,
                const ElasticData      &data,
                const unsigned int      first,
                const unsigned int      end,
                const double           *source,
                double                 *sums)
    {
      using Kernel = QuadratureKernel<n_nodes>;
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, f{};
          typename Kernel::Geometry    g;
          gather_batch<Kernel::n_nodes>(data.batches, batch, source, u);
          Kernel::load(shapes, g);
          V R[3][3];
          rotations_of(data, batch, R);
          const V    mu = lanes(shapes.mu), lambda = lanes(shapes.lambda);
          const auto stress =
            [&](const unsigned int, const V(&grad_u)[3][3], V(&P)[3][3]) {
              corotational_tangent(R, lambda, mu, grad_u, P);
            };
          const auto &rule =
            cell_rule(is_curved, reference, data.batches, batch);
          Kernel::integrate(rule, g, lanes(shapes.volume), u, f, stress);
          scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
        }
    }
  } // namespace

  namespace
  {
    template <int n_nodes, bool at_points>
    void
    sweep_state(const ReferenceElement &reference,
                const ElasticData      &data,
                const unsigned int      first,
                const unsigned int      end,
                const double           *displacement,
                PointResults           &results)
    {
      for_each_kind(data.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      run_state<n_nodes, at_points>(curved,
                                                    reference,
                                                    data,
                                                    begin,
                                                    stop,
                                                    displacement,
                                                    results);
                    });
    }

    template <int n_nodes, bool variational>
    void
    sweep_force(const ReferenceElement &reference,
                ElasticData            &data,
                const unsigned int      first,
                const unsigned int      end,
                const double           *displacement,
                double                 *sums)
    {
      for_each_kind(
        data.batches,
        first,
        end,
        [&](const auto begin, const auto stop, const auto curved) {
          if constexpr (variational)
            run_variational_force<n_nodes>(
              curved, reference, data, begin, stop, displacement, sums);
          else
            run_force_at_points<n_nodes>(
              curved, reference, data, begin, stop, displacement, sums);
        });
    }

    template <int n_nodes>
    void
    sweep_tangent(const ReferenceElement &reference,
                  const ElasticData      &data,
                  const unsigned int      first,
                  const unsigned int      end,
                  const double           *source,
                  double                 *sums)
    {
      for_each_kind(data.batches,
                    first,
                    end,
                    [&](const auto begin, const auto stop, const auto curved) {
                      run_tangent<n_nodes>(
                        curved, reference, data, begin, stop, source, sums);
                    });
    }
  } // namespace

  StateSweep
  state_sweep(const Element element, const Rotation rotation)
  {
    StateSweep result = nullptr;
    with_kernel<double>(element, [&](const auto kernel) {
      constexpr int n_nodes = decltype(kernel)::type::n_nodes;
      result                = rotation == Rotation::quadrature_points ?
                                sweep_state<n_nodes, true> :
                                sweep_state<n_nodes, false>;
    });
    return result;
  }

  PointForceSweep
  point_force_sweep(const Element element, const Rotation rotation)
  {
    PointForceSweep result = nullptr;
    with_kernel<double>(element, [&](const auto kernel) {
      constexpr int n_nodes = decltype(kernel)::type::n_nodes;
      result                = rotation == Rotation::quadrature_points ?
                                sweep_force<n_nodes, false> :
                                sweep_force<n_nodes, true>;
    });
    return result;
  }

  QuadratureSweep
  tangent_by_quadrature_sweep(const Element element)
  {
    QuadratureSweep result = nullptr;
    with_kernel<double>(element, [&](const auto kernel) {
      result = sweep_tangent<decltype(kernel)::type::n_nodes>;
    });
    return result;
  }
} // namespace corotet
