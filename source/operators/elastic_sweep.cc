// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/point_operations.h>

namespace corotet
{
  namespace
  {
    // Computes F = I + grad u at the centres of the cells.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    deformation_gradient(const CellGeometryAtRest           &at_rest,
                         const typename Kernel::NodalValues &u,
                         Simd<double> (&F)[3][3])
    {
      Simd<double> by_xi[3][3];
      Kernel::centre_gradient(u, by_xi);
      static_for<3>([&](auto b) {
        static_for<3>([&](auto a) {
          Simd<double> sum = broadcast(a == b ? 1. : 0.);
          static_for<3>([&](auto k) {
            sum += by_xi[a][k] * lanes(at_rest.inverse_jacobian[3 * k + b]);
          });
          F[a][b] = sum;
        });
      });
    }

    // Stores the gradients of the cells, rotated.
    COROTET_ALWAYS_INLINE void
    store_rotated(const Simd<double> (&R)[3][3],
                  const ElasticData &data,
                  const unsigned int batch)
    {
      const Simd<double>        scale   = lanes(data.constants[batch].scale);
      const CellGeometryAtRest &at_rest = data.at_rest[batch];
      CellCoefficients<double> &coefficients = data.new_coefficients[batch];
      static_for<3>([&](auto k) {
        Simd<double> g[3];
        static_for<3>([&](auto b) {
          g[b] = scale * lanes(at_rest.inverse_jacobian[3 * k + b]);
        });
        static_for<3>([&](auto a) {
          store_aligned(R[a][0] * g[0] + R[a][1] * g[1] + R[a][2] * g[2],
                        coefficients.gradients[3 * k + a]);
        });
      });
    }

    // The strain of the body at rest in the rotated frame, sym(R) - I, in the
    // kernel's units.
    template <typename Kernel>
    COROTET_ALWAYS_INLINE void
    strain_offset(const Simd<double> (&R)[3][3],
                  const CellConstants    &constants,
                  typename Kernel::Strain offset)
    {
      const Simd<double> s =
        load_aligned<batch_size>(constants.scale) * Kernel::strain_scale;
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
      using Quadrature           = QuadratureKernel<Kernel::n_nodes>;
      const CellConstants &cells = data.constants[batch];
      const auto [lambda, mu]    = lame(data, batch);
      typename Quadrature::Geometry g;
      load_at_rest(data, batch, g);
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
                              Simd<double> e[3][3], sigma[3][3];
                              corotational_strain(R, grad_u, e);
                              isotropic_stress(lambda, mu, e, sigma);
                              times(R, sigma, P);
                            });
    }

    // Computes new rotations of the cells, the internal force, or both.
    template <typename CellKernel, bool rotate>
    struct Rotations
    {
      using Data   = ElasticData;
      using Number = double;

      static constexpr unsigned int n_batches = 1;

      static COROTET_ALWAYS_INLINE void
      fetch(const ElasticData &data, const unsigned int batch)
      {
        fetch_object(data.constants + batch);
        fetch_object(data.coefficients + batch);
        if (data.has_rotations())
          fetch_object(data.at_rest + batch);
      }

      /// The rotations of a batch, new ones from the displacement or the
      /// present ones.
      static COROTET_ALWAYS_INLINE void
      get(ElasticData                            &data,
          const unsigned int                      batch,
          const typename CellKernel::NodalValues &u,
          Tensor2Lanes                           &R)
      {
        if constexpr (rotate)
          {
            Tensor2Lanes F;
            deformation_gradient<CellKernel>(data.at_rest[batch], u, F);
            const PolarLanes found = polar_decomposition(F, R);
            data.counts.add(found, data.constants[batch]);
            store_rotated(R, data, batch);
          }
        else
          rotations_of(data, batch, R);
      }
    };

    // Computes rotations only; they are those at the centres, where curved
    // cells need no other treatment.
    template <typename CellKernel>
    struct RotationOnly : Rotations<CellKernel, true>
    {
      static constexpr bool ignores_curvature = true;

      static COROTET_ALWAYS_INLINE void
      apply(const std::false_type,
            ElasticData       &data,
            const unsigned int batch,
            const double      *source,
            double *)
      {
        typename CellKernel::NodalValues u;
        Tensor2Lanes                     R;
        gather_differences<CellKernel::n_nodes>(data.batches, batch, source, u);
        RotationOnly::get(data, batch, u, R);
      }
    };

    template <typename CellKernel, bool rotate>
    struct CellForce : Rotations<CellKernel, rotate>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *source,
            double            *sums)
      {
        typename CellKernel::NodalValues u, f;
        Tensor2Lanes                     R;
        gather_differences<CellKernel::n_nodes>(data.batches, batch, source, u);
        CellForce::get(data, batch, u, R);
        if constexpr (IsCurved::value)
          curved_force<CellKernel>(data, batch, R, u, f);
        else
          {
            typename CellKernel::Strain offset;
            strain_offset<CellKernel>(R, data.constants[batch], offset);
            CellKernel::template apply<true, false, true>(
              &data.coefficients[batch], Simd<double>{}, &offset, u, f);
          }
        scatter_add<CellKernel::n_nodes>(data.batches, batch, f, sums);
      }
    };

    struct TangentByQuadrature
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *source, double *sums)
      {
        typename Points::NodalValues u, f{};
        Tensor2Lanes                 R;
        gather_batch<Points::n_nodes>(points.data.batches,
                                      points.batch,
                                      source,
                                      u);
        points.load_geometry();
        rotations_of(points.data, points.batch, R);
        const auto [lambda, mu] = points.lame();
        const auto stress =
          [&](const unsigned int, const Tensor2Lanes &grad_u, Tensor2Lanes &P) {
            corotational_tangent(R, lambda, mu, grad_u, P);
          };
        points.integrate(u, f, stress);
        points.add_to(sums, f);
      }
    };
  } // namespace

  ElasticSweep
  rotation_sweep(const Element element)
  {
    return sweep_of_element<double>(
      element, []<typename Kernel>(const std::type_identity<Kernel>) {
        return BatchSweep<RotationOnly<Kernel>>::run;
      });
  }

  ElasticSweep
  force_sweep(const Element element)
  {
    return sweep_of_element<double>(
      element, []<typename Kernel>(const std::type_identity<Kernel>) {
        return BatchSweep<CellForce<Kernel, false>>::run;
      });
  }

  ElasticSweep
  rotation_and_force_sweep(const Element element)
  {
    return sweep_of_element<double>(
      element, []<typename Kernel>(const std::type_identity<Kernel>) {
        return BatchSweep<CellForce<Kernel, true>>::run;
      });
  }

  ElasticSweep
  tangent_by_quadrature_sweep(const Element element)
  {
    return point_sweep<TangentByQuadrature>(element);
  }
} // namespace corotet
