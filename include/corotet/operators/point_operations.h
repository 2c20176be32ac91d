// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_point_operations_h
#define corotet_operators_point_operations_h

#include <corotet/material/corotational_simd.h>
#include <corotet/operators/batch_sweep.h>
#include <corotet/operators/curved_kernel.h>
#include <corotet/operators/elastic_sweeps.h>
#include <corotet/operators/gather.h>
#include <corotet/operators/quadrature_kernel.h>

/**
 * What the operations on a batch's quadrature points have in common.
 */
namespace corotet
{
  /// Stores numbers, one register after another.
  struct NumberWriter
  {
    double *next;

    template <int n>
    COROTET_ALWAYS_INLINE void
    write(const Simd<double> (&values)[n])
    {
      static_for<n>(
        [&](auto i) { store_aligned(values[i], next + i * batch_size); });
      next += n * batch_size;
    }

    COROTET_ALWAYS_INLINE void
    write(const Tensor2Lanes &values)
    {
      static_for<9>([&](auto i) {
        store_aligned(values[i / 3][i % 3], next + i * batch_size);
      });
      next += 9 * batch_size;
    }
  };

  /// Reads them.
  struct NumberReader
  {
    const double *next;

    template <int n>
    COROTET_ALWAYS_INLINE void
    read(Simd<double> (&values)[n])
    {
      static_for<n>([&](auto i) { values[i] = lanes(next + i * batch_size); });
      next += n * batch_size;
    }

    COROTET_ALWAYS_INLINE void
    read(Tensor2Lanes &values)
    {
      static_for<9>(
        [&](auto i) { values[i / 3][i % 3] = lanes(next + i * batch_size); });
      next += 9 * batch_size;
    }
  };

  /// What operations on the quadrature points of a batch have.
  template <typename CellKernel>
  struct PointOperation
  {
    using Data   = ElasticData;
    using Number = double;
    using Kernel = QuadratureKernel<CellKernel::n_nodes>;

    using NodalValues = typename Kernel::NodalValues;
    using Geometry    = typename Kernel::Geometry;

    static constexpr unsigned int n_batches = 1;

    /// Counts lanes with a cell where a derivative was bounded.
    static COROTET_ALWAYS_INLINE void
    count_clamped(const unsigned int clamped,
                  const CellShapes  &shapes,
                  ElasticData       &data)
    {
      if (__builtin_expect(clamped != 0, 0))
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          data.n_clamped +=
            (clamped >> lane & 1u) != 0 && shapes.volume[lane] > 0;
    }

    static COROTET_ALWAYS_INLINE Simd<double>
                                 determinant_of_F(const Tensor2Lanes &H)
    {
      const Simd<double> a = H[0][0] + 1., b = H[1][1] + 1., c = H[2][2] + 1.;
      return a * (b * c - H[1][2] * H[2][1]) -
             H[0][1] * (H[1][0] * c - H[1][2] * H[2][0]) +
             H[0][2] * (H[1][0] * H[2][1] - b * H[2][0]);
    }

    /// det F and the energy of a batch. @p energy gives that per volume at rest
    /// from grad u.
    template <typename IsCurved, typename Energy>
    static COROTET_ALWAYS_INLINE void
    add_state(const IsCurved     is_curved,
              ElasticData       &data,
              const unsigned int batch,
              const double      *displacement,
              const Energy      &energy)
    {
      // Of cells that are exactly flat, but for round-off.
      constexpr double  flat   = 1e-12;
      const CellShapes &shapes = data.shapes[batch];
      const auto       &rule =
        cell_rule(is_curved, data.reference, data.batches, batch);
      NodalValues  u;
      Geometry     g;
      Tensor2Lanes H;
      Kernel::load(data, batch, displacement, g, u);
      Kernel::gradient(data.reference.centre, 0, g, u, H);
      Simd<double> det_F = determinant_of_F(H), sum{};
      for (unsigned int q = 0; q < n_points(rule); ++q)
        {
          Kernel::gradient(rule, q, g, u, H);
          const Simd<double> det = determinant_of_F(H);
          det_F                  = det < det_F ? det : det_F;
          sum += weight_at(rule, q) * energy(H);
        }
      PointResults &results = data.results;
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        if (shapes.volume[lane] > 0)
          {
            results.energy += sum[lane] * shapes.volume[lane];
            results.min_det_F = std::min(results.min_det_F, det_F[lane]);
            results.inverted_cells += det_F[lane] < -flat;
          }
    }

    /**
     * f = (mass_factor M + stiffness_factor K) source, with K that of the
     * cells' frozen rotations; u is the source.
     */
    template <bool is_curved>
    static COROTET_ALWAYS_INLINE void
    gather_with_matrices(const ElasticData &data,
                         const unsigned int batch,
                         const double      *source,
                         const double       stiffness_factor,
                         NodalValues       &u,
                         NodalValues       &f)
    {
      constexpr int n_nodes = CellKernel::n_nodes;
      gather_batch<n_nodes>(data.batches, batch, source, u);
      if (data.masses != nullptr)
        {
          NodalValues copy;
          static_for<3 * n_nodes>(
            [&](auto ia) { copy[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
          const Simd<double> masses =
            data.mass_factor * lanes(data.masses[batch].mass);
          if constexpr (is_curved)
            CurvedKernel<n_nodes, double>::template apply<false, true>(
              *data.batches.curved(), batch, nullptr, 0., masses, copy, f);
          else
            CellKernel::template apply<false, true>(
              nullptr, CellKernel::mass_scale * masses, nullptr, copy, f);
        }
      else
        static_for<3 * n_nodes>(
          [&](auto ia) { f[ia / 3][ia % 3] = Simd<double>{}; });
      if (stiffness_factor != 0.)
        add_frozen<is_curved>(data, batch, stiffness_factor, u, f);
    }

  private:
    template <bool is_curved>
    static COROTET_ALWAYS_INLINE void
    add_frozen(const ElasticData &data,
               const unsigned int batch,
               const double       factor,
               const NodalValues &u,
               NodalValues       &f)
    {
      constexpr int n_nodes = CellKernel::n_nodes;
      NodalValues   copy, Ku;
      static_for<3 * n_nodes>(
        [&](auto ia) { copy[ia / 3][ia % 3] = u[ia / 3][ia % 3]; });
      if constexpr (is_curved)
        CurvedKernel<n_nodes, double>::template apply<true, false>(
          *data.batches.curved(),
          batch,
          data.coefficients + batch,
          1.,
          Simd<double>{},
          copy,
          Ku);
      else
        CellKernel::template apply<true, false>(
          data.coefficients + batch, Simd<double>{}, nullptr, copy, Ku);
      const double scale =
        factor * (is_curved ? 1. : CellKernel::stiffness_scale);
      static_for<3 * n_nodes>(
        [&](auto ia) { f[ia / 3][ia % 3] += scale * Ku[ia / 3][ia % 3]; });
    }
  };
} // namespace corotet

#endif
