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
  /**
   * Numbers of quadrature points in memory, one register after another. They
   * extend over many pages, and processors do not prefetch beyond a page by
   * themselves: so numbers are prefetched here one page ahead.
   */
  template <typename T>
  struct NumberStream
  {
    static constexpr std::size_t page = 4096 / sizeof(double);

    T *next;

    /// The place of the @p i-th register from here on.
    COROTET_ALWAYS_INLINE T *
    place(const int i) const
    {
      T *const result = next + std::size_t(i) * batch_size;
      __builtin_prefetch(result + page, std::is_const_v<T> ? 0 : 1);
      return result;
    }
  };

  /// Stores these numbers.
  struct NumberWriter : NumberStream<double>
  {
    template <int n>
    COROTET_ALWAYS_INLINE void
    write(const Simd<double> (&values)[n])
    {
      static_for<n>([&](auto i) { store_aligned(values[i], place(i)); });
      next += std::size_t(n) * batch_size;
    }

    COROTET_ALWAYS_INLINE void
    write(const Tensor2Lanes &values)
    {
      static_for<9>(
        [&](auto i) { store_aligned(values[i / 3][i % 3], place(i)); });
      next += std::size_t(9) * batch_size;
    }
  };

  /// Reads these numbers.
  struct NumberReader : NumberStream<const double>
  {
    template <int n>
    COROTET_ALWAYS_INLINE void
    read(Simd<double> (&values)[n])
    {
      static_for<n>([&](auto i) { values[i] = lanes(place(i)); });
      next += std::size_t(n) * batch_size;
    }

    COROTET_ALWAYS_INLINE void
    read(Tensor2Lanes &values)
    {
      static_for<9>([&](auto i) { values[i / 3][i % 3] = lanes(place(i)); });
      next += std::size_t(9) * batch_size;
    }
  };

  /**
   * A batch of cells on whose quadrature points an operation works, and the
   * steps that operations have in common. Nodal values are not members: the
   * rare way of reading them is a function call, for which all members would
   * have to be in memory.
   */
  template <typename CellKernel, bool is_curved>
  class PointBatch
  {
  public:
    using Cell = CellKernel;

    static constexpr int  n_nodes         = CellKernel::n_nodes;
    static constexpr bool is_curved_batch = is_curved;

    using Kernel      = QuadratureKernel<n_nodes>;
    using NodalValues = typename Kernel::NodalValues;
    using Geometry    = typename Kernel::Geometry;

    COROTET_ALWAYS_INLINE
    PointBatch(ElasticData &data, const unsigned int batch)
      : data(data)
      , batch(batch)
      , constants(data.constants[batch])
    {}

    COROTET_ALWAYS_INLINE LameLanes
    lame() const
    {
      return corotet::lame(data, batch);
    }

    COROTET_ALWAYS_INLINE decltype(auto)
    rule() const
    {
      return cell_rule(std::bool_constant<is_curved>(),
                       data.reference,
                       data.batches,
                       batch);
    }

    /// The volume at rest that belongs to point @p q.
    COROTET_ALWAYS_INLINE Simd<double>
                          weight(const unsigned int q) const
    {
      return weight_at(rule(), q) * lanes(constants.volume);
    }

    /// Loads the geometry at rest.
    COROTET_ALWAYS_INLINE void
    load_geometry()
    {
      load_at_rest(data, batch, g);
    }

    /// Loads the geometry at rest, and the displacement minus that of the first
    /// node.
    COROTET_ALWAYS_INLINE void
    load(const double *displacement, NodalValues &u)
    {
      Kernel::load(data, batch, displacement, g, u);
    }

    COROTET_ALWAYS_INLINE void
    gradient_at_centre(const NodalValues &u, Tensor2Lanes &H) const
    {
      Kernel::gradient(data.reference.centre, 0, g, u, H);
    }

    /// Calls @p function(q, grad u) for each point.
    template <typename Function>
    COROTET_ALWAYS_INLINE void
    for_each_point(const NodalValues &u, const Function &function) const
    {
      Kernel::for_each_point(rule(), g, u, function);
    }

    /// f_i += sum_q w_q P(q, grad u) grad N_i. @p stress(q, grad u, P)
    /// computes P.
    template <typename Stress>
    COROTET_ALWAYS_INLINE void
    integrate(const NodalValues &u, NodalValues &f, const Stress &stress) const
    {
      Kernel::integrate(rule(), g, lanes(constants.volume), u, f, stress);
    }

    /// f_i += P grad N_i at the centre.
    COROTET_ALWAYS_INLINE void
    add_at_centre(const Tensor2Lanes &P, NodalValues &f) const
    {
      Kernel::add(data.reference.centre, 0, g, P, f);
    }

    /// Adds the nodal values @p f to a sweep's sums.
    COROTET_ALWAYS_INLINE void
    add_to(double *sums, const NodalValues &f) const
    {
      scatter_add<n_nodes>(data.batches, batch, f, sums);
    }

    /// The place where the batch's numbers of a linearization are written.
    COROTET_ALWAYS_INLINE NumberWriter
    writer(const LinearizationSize size) const
    {
      return {{data.new_linearization +
               linearization_start<is_curved>(data, size, batch)}};
    }

    COROTET_ALWAYS_INLINE NumberReader
    reader(const LinearizationSize size) const
    {
      return {{data.linearization +
               linearization_start<is_curved>(data, size, batch)}};
    }

    /// Counts lanes with a cell where a derivative was bounded.
    COROTET_ALWAYS_INLINE void
    count_clamped(const unsigned int clamped) const
    {
      if (__builtin_expect(static_cast<long>(clamped != 0), 0))
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          if ((clamped >> lane & 1u) != 0 && constants.volume[lane] > 0)
            ++data.n_clamped;
    }

    /// Adds det F and the energy of the batch to the results. @p energy(grad u)
    /// is the energy per volume at rest.
    template <typename Energy>
    COROTET_ALWAYS_INLINE void
    add_state(const double *displacement, const Energy &energy)
    {
      // Tolerance for cells that are exactly flat, up to round-off.
      constexpr double flat = 1e-12;
      NodalValues      u;
      Tensor2Lanes     centre;
      load(displacement, u);
      gradient_at_centre(u, centre);
      Simd<double> det_F = determinant_of_F(centre), sum{};
      for_each_point(u, [&](const unsigned int q, const Tensor2Lanes &H) {
        const Simd<double> det = determinant_of_F(H);
        det_F                  = det < det_F ? det : det_F;
        sum += weight_at(rule(), q) * energy(H);
      });
      PointResults &results = data.results;
      for (unsigned int lane = 0; lane < batch_size; ++lane)
        if (constants.volume[lane] > 0)
          {
            results.energy += sum[lane] * constants.volume[lane];
            results.min_det_F = std::min(results.min_det_F, det_F[lane]);
            results.inverted_cells += det_F[lane] < -flat;
          }
    }

    /**
     * f = (mass_factor M + stiffness_factor K) source, with the K of the cells'
     * frozen rotations; u is the source.
     */
    COROTET_ALWAYS_INLINE void
    gather_with_matrices(const double *source,
                         const double  stiffness_factor,
                         NodalValues  &u,
                         NodalValues  &f) const
    {
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
        add_frozen(stiffness_factor, u, f);
    }

    ElasticData         &data;
    const unsigned int   batch;
    const CellConstants &constants;
    /// The geometry of load(), or another one that an operation sets.
    Geometry g;

  private:
    static COROTET_ALWAYS_INLINE Simd<double>
                                 determinant_of_F(const Tensor2Lanes &H)
    {
      const Simd<double> a = H[0][0] + 1., b = H[1][1] + 1., c = H[2][2] + 1.;
      return a * (b * c - H[1][2] * H[2][1]) -
             H[0][1] * (H[1][0] * c - H[1][2] * H[2][0]) +
             H[0][2] * (H[1][0] * H[2][1] - b * H[2][0]);
    }

    COROTET_ALWAYS_INLINE void
    add_frozen(const double factor, const NodalValues &u, NodalValues &f) const
    {
      NodalValues copy, Ku;
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

  /**
   * An operation on points as one of BatchSweep. Operation::apply(points,
   * source, sums) does the work on the PointBatch @p points.
   */
  template <typename Operation, typename CellKernel>
  struct PointOperation
  {
    using Data   = ElasticData;
    using Number = double;

    static constexpr unsigned int n_batches  = 1;
    static constexpr bool         works_long = true;

    static COROTET_ALWAYS_INLINE void
    fetch(const ElasticData &data, const unsigned int batch)
    {
      fetch_object(data.constants + batch);
      if (data.has_rotations())
        fetch_object(data.at_rest + batch);
      else
        fetch_object(data.coefficients + batch);
    }

    template <typename IsCurved>
    static COROTET_ALWAYS_INLINE void
    apply(const IsCurved,
          ElasticData       &data,
          const unsigned int batch,
          const double      *source,
          double            *sums)
    {
      PointBatch<CellKernel, IsCurved::value> points(data, batch);
      Operation::apply(points, source, sums);
    }
  };

  /// The sweep of an operation on points, for one element.
  template <typename Operation>
  ElasticSweep
  point_sweep(const Element element)
  {
    return sweep_of_element<double>(
      element, []<typename Kernel>(const std::type_identity<Kernel>) {
        return BatchSweep<PointOperation<Operation, Kernel>>::run;
      });
  }
} // namespace corotet

#endif
