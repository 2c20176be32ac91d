// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>
#include <corotet/operators/sweep.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  namespace
  {
    // F = I + grad u at the centres of the cells.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    deformation_gradient(const CellShapes                   &shapes,
                         const typename Kernel::NodalValues &u,
                         Simd<double> (&F)[3][3])
    {
      Simd<double> by_xi[3][3];
      Kernel::centre_gradient(u, by_xi);
      static_for<3>([&](auto b) {
        static_for<3>([&](auto a) {
          Simd<double> sum = broadcast(a == b ? 1. : 0.);
          static_for<3>([&](auto k) {
            sum += by_xi[a][k] *
                   load_aligned<batch_size>(shapes.inverse_jacobian[3 * k + b]);
          });
          F[a][b] = sum;
        });
      });
    }

    // Rotates the gradients of the cells.
    COROTET_ALWAYS_INLINE void
    store_rotated(const Simd<double> (&R)[3][3],
                  const CellShapes         &shapes,
                  CellCoefficients<double> &coefficients)
    {
      const Simd<double> scale = load_aligned<batch_size>(shapes.scale);
      static_for<3>([&](auto k) {
        Simd<double> g[3];
        static_for<3>([&](auto b) {
          g[b] = scale *
                 load_aligned<batch_size>(shapes.inverse_jacobian[3 * k + b]);
        });
        static_for<3>([&](auto a) {
          store_aligned(R[a][0] * g[0] + R[a][1] * g[1] + R[a][2] * g[2],
                        coefficients.gradients[3 * k + a]);
        });
      });
    }

    // Strain of the body at rest as the rotations see it, sym(R) - I, in the
    // kernel's units.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    strain_offset(const Simd<double> (&R)[3][3],
                  const CellShapes       &shapes,
                  typename Kernel::Strain offset)
    {
      const Simd<double> s =
        load_aligned<batch_size>(shapes.scale) * Kernel::strain_scale;
      static_for<3>([&](auto a) { offset[a] = s * (R[a][a] - 1.); });
      offset[3] = s * (R[1][2] + R[2][1]);
      offset[4] = s * (R[0][2] + R[2][0]);
      offset[5] = s * (R[0][1] + R[1][0]);
    }

    // f = the internal force of curved cells with the rotations R, in units of
    // stiffness_scale.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    curved_force(const ElasticData &data,
                 const unsigned int batch,
                 const Simd<double> (&R)[3][3],
                 const typename Kernel::NodalValues &u,
                 typename Kernel::NodalValues       &f)
    {
      using Quadrature         = QuadratureKernel<Kernel::n_nodes>;
      const CellShapes  &cells = data.shapes[batch];
      const Simd<double> mu = lanes(cells.mu), lambda = lanes(cells.lambda);
      typename Quadrature::Geometry g;
      Quadrature::load(cells, g);
      static_for<3 * Kernel::n_nodes>(
        [&](auto ia) { f[ia / 3][ia % 3] = Simd<double>{}; });
      const CurvedRule rule{data.batches.curved()->shapes(),
                            data.batches.curved()->numbers<double>(batch)};
      Quadrature::integrate(rule,
                            g,
                            lanes(cells.volume) * (1 / Kernel::stiffness_scale),
                            u,
                            f,
                            [&](const unsigned int,
                                const Simd<double>(&grad_u)[3][3],
                                Simd<double>(&P)[3][3]) {
                              // The strain sym(R^T grad u) + (sym(R) - I).
                              Simd<double> A[3][3], sigma[3][3];
                              transposed_times(R, grad_u, A);
                              static_for<9>([&](auto ab) {
                                constexpr int a = ab / 3, b = ab % 3;
                                A[a][b] += R[b][a] - (a == b ? 1. : 0.);
                              });
                              isotropic_stress(lambda, mu, A, sigma);
                              times(R, sigma, P);
                            });
    }

    template <typename Kernel, bool rotate, bool with_force, typename IsCurved>
    __attribute__((flatten)) void
    run_elastic(const IsCurved,
                ElasticData       &data,
                const unsigned int first,
                const unsigned int end,
                const double      *source,
                double            *sums)
    {
      for (unsigned int batch = first; batch < end; ++batch)
        {
          const CellShapes            &shapes = data.shapes[batch];
          typename Kernel::NodalValues u, v;
          gather_differences<Kernel::n_nodes>(data.batches, batch, source, u);
          Simd<double> R[3][3];
          if constexpr (rotate)
            {
              Simd<double> F[3][3];
              deformation_gradient<Kernel>(shapes, u, F);
              const PolarLanes lanes = polar_decomposition(F, R);
              data.counts.add(lanes, shapes);
              store_rotated(R, shapes, data.new_coefficients[batch]);
            }
          else
            rotations_of(data, batch, R);
          if constexpr (with_force && IsCurved::value)
            {
              curved_force<Kernel>(data, batch, R, u, v);
              scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
            }
          else if constexpr (with_force)
            {
              typename Kernel::Strain offset;
              strain_offset<Kernel>(R, shapes, offset);
              Kernel::template apply<true, false, true>(
                &data.coefficients[batch], Simd<double>{}, &offset, u, v);
              scatter_add<Kernel::n_nodes>(v, data.batches.nodes(batch), sums);
            }
        }
    }

    template <typename Kernel, bool rotate, bool with_force>
    void
    sweep_elastic(ElasticData       &data,
                  const unsigned int first,
                  const unsigned int end,
                  const double      *source,
                  double            *sums)
    {
      // Rotations are those of the centres, where a curved cell is like others.
      if constexpr (!with_force)
        run_elastic<Kernel, rotate, with_force>(
          std::false_type(), data, first, end, source, sums);
      else
        for_each_kind(data.batches,
                      first,
                      end,
                      [&](const auto begin,
                          const auto stop,
                          const auto curved) {
                        run_elastic<Kernel, rotate, with_force>(
                          curved, data, begin, stop, source, sums);
                      });
    }

    template <bool rotate, bool with_force>
    ElasticSweep
    elastic_sweep(const Element element)
    {
      ElasticSweep result = nullptr;
      with_kernel<double>(element, [&](const auto kernel) {
        using Kernel = typename decltype(kernel)::type;
        result       = sweep_elastic<Kernel, rotate, with_force>;
      });
      return result;
    }
  } // namespace

  ElasticSweep
  rotation_sweep(const Element element)
  {
    return elastic_sweep<true, false>(element);
  }

  ElasticSweep
  force_sweep(const Element element)
  {
    return elastic_sweep<false, true>(element);
  }

  ElasticSweep
  rotation_and_force_sweep(const Element element)
  {
    return elastic_sweep<true, true>(element);
  }
} // namespace corotet
