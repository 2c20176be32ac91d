// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_law_sweeps_h
#define corotet_operators_law_sweeps_h

#include <corotet/material/law_at_points.h>
#include <corotet/operators/point_operations.h>

/**
 * The work that a law at points has on cells.
 */
namespace corotet
{
  namespace internal
  {
    /// The law of a sweep. A copy, so that its parameters may stay in
    /// registers.
    template <Law L>
    COROTET_ALWAYS_INLINE L
    law_of(const ElasticData &data)
    {
      return *static_cast<const L *>(data.law);
    }

    /// f_i = sum_q w_q P(F_q) grad N_i.
    template <typename CellKernel, Law L>
    struct ForceOfLaw : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double            *sums)
      {
        using Kernel             = typename ForceOfLaw::Kernel;
        const L           law    = law_of<L>(data);
        const CellShapes &shapes = data.shapes[batch];
        const LameLanes   lame   = corotet::lame(shapes);
        constexpr bool    has_counts =
          std::same_as<decltype(law.stress(lame,
                                           std::declval<const Tensor2Lanes &>(),
                                           std::declval<Tensor2Lanes &>())),
                       PolarLanes>;
        typename Kernel::NodalValues u, f{};
        typename Kernel::Geometry    g;
        Kernel::load(data, batch, displacement, g, u);
        PolarLanes found;
        const auto stress =
          [&](const unsigned int, const Tensor2Lanes &H, Tensor2Lanes &P) {
            if constexpr (has_counts)
              found |= law.stress(lame, H, P);
            else
              law.stress(lame, H, P);
          };
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        Kernel::integrate(rule, g, lanes(shapes.volume), u, f, stress);
        if constexpr (has_counts)
          data.counts.add(found, shapes);
        scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
      }
    };

    template <typename CellKernel, Law L>
    struct StateOfLaw : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double *)
      {
        const L         law  = law_of<L>(data);
        const LameLanes lame = corotet::lame(data.shapes[batch]);
        StateOfLaw::add_state(
          is_curved, data, batch, displacement, [&](const Tensor2Lanes &H) {
            return law.energy_density(lame, H);
          });
      }
    };

    template <Law L, Tangent tangent>
    constexpr int n_stored = [] {
      if constexpr (tangent == Tangent::frozen_rotation)
        return L::n_frozen;
      else
        return L::n_stored;
    }();

    template <typename CellKernel, Law L, Tangent tangent>
    struct LinearizationOfLaw : PointOperation<CellKernel>
    {
      static constexpr LinearizationSize size{0, n_stored<L, tangent>};

      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *displacement,
            double *)
      {
        using Kernel                     = typename LinearizationOfLaw::Kernel;
        const L                      law = law_of<L>(data);
        const CellShapes            &shapes = data.shapes[batch];
        const LameLanes              lame   = corotet::lame(shapes);
        typename Kernel::NodalValues u;
        typename Kernel::Geometry    g;
        Kernel::load(data, batch, displacement, g, u);
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        NumberWriter numbers{
          data.new_linearization +
          linearization_start<IsCurved::value>(data, size, batch)};
        unsigned int clamped = 0;
        for (unsigned int q = 0; q < n_points(rule); ++q)
          {
            Tensor2Lanes                      H;
            NumberLanes<n_stored<L, tangent>> stored;
            Kernel::gradient(rule, q, g, u, H);
            if constexpr (tangent == Tangent::frozen_rotation)
              law.linearize_frozen(H, stored);
            else
              clamped |= law.linearize(lame, H, stored);
            numbers.write(stored);
          }
        LinearizationOfLaw::count_clamped(clamped, shapes, data);
      }
    };

    template <typename CellKernel, Law L, Tangent tangent>
    struct TangentOfLaw : PointOperation<CellKernel>
    {
      template <typename IsCurved>
      static COROTET_ALWAYS_INLINE void
      apply(const IsCurved     is_curved,
            ElasticData       &data,
            const unsigned int batch,
            const double      *source,
            double            *sums)
      {
        using Kernel                        = typename TangentOfLaw::Kernel;
        const L                      law    = law_of<L>(data);
        const CellShapes            &shapes = data.shapes[batch];
        const LameLanes              lame   = corotet::lame(shapes);
        typename Kernel::NodalValues u, f;
        typename Kernel::Geometry    g;
        TangentOfLaw::template gather_with_matrices<IsCurved::value>(
          data,
          batch,
          source,
          LawWithFrozenForm<L> ? 0. : data.frozen_factor - 1.,
          u,
          f);
        Kernel::load(shapes, g);
        const auto &rule =
          cell_rule(is_curved, data.reference, data.batches, batch);
        NumberReader numbers{
          data.linearization +
          linearization_start<IsCurved::value>(
            data, LinearizationOfLaw<CellKernel, L, tangent>::size, batch)};
        const auto stress =
          [&](const unsigned int, const Tensor2Lanes &dF, Tensor2Lanes &dP) {
            NumberLanes<n_stored<L, tangent>> stored;
            numbers.read(stored);
            if constexpr (tangent == Tangent::frozen_rotation)
              law.frozen_derivative({data.frozen_factor * lame.lambda,
                                     data.frozen_factor * lame.mu},
                                    stored,
                                    dF,
                                    dP);
            else if constexpr (LawWithFrozenForm<L>)
              law.derivative(lame, data.frozen_factor, stored, dF, dP);
            else
              law.derivative(lame, stored, dF, dP);
          };
        Kernel::integrate(rule, g, lanes(shapes.volume), u, f, stress);
        scatter_add<Kernel::n_nodes>(f, data.batches.nodes(batch), sums);
      }
    };

    template <Law L, Tangent tangent>
    TangentSweeps
    tangent_sweeps(const Element element)
    {
      return {
        {0, n_stored<L, tangent>},
        sweep_of_element<double>(
          element,
          []<typename Kernel>(const std::type_identity<Kernel>) {
            return BatchSweep<LinearizationOfLaw<Kernel, L, tangent>>::run;
          }),
        sweep_of_element<double>(
          element, []<typename Kernel>(const std::type_identity<Kernel>) {
            return BatchSweep<TangentOfLaw<Kernel, L, tangent>>::run;
          })};
    }
  } // namespace internal

  /**
   * A Law as a MaterialLaw: with the kernels for all elements, which the
   * compiler makes where this is instantiated. A law needs one instance, in one
   * source.
   */
  template <Law L>
  class MaterialLawOf : public LawAtPoints<L>
  {
  public:
    using LawAtPoints<L>::LawAtPoints;

    ElasticSweeps
    sweeps(const Element element) const override
    {
      ElasticSweeps result;
      result.law   = &this->law;
      result.state = sweep_of_element<double>(
        element, []<typename Kernel>(const std::type_identity<Kernel>) {
          return BatchSweep<internal::StateOfLaw<Kernel, L>>::run;
        });
      if constexpr (is_linear_law<L>)
        {
          result.force       = force_sweep(element);
          result.force_scale = stiffness_scale(element);
        }
      else
        {
          result.force = sweep_of_element<double>(
            element, []<typename Kernel>(const std::type_identity<Kernel>) {
              return BatchSweep<internal::ForceOfLaw<Kernel, L>>::run;
            });
          result.consistent =
            internal::tangent_sweeps<L, Tangent::consistent>(element);
          if constexpr (LawWithFrozenForm<L>)
            result.frozen =
              internal::tangent_sweeps<L, Tangent::frozen_rotation>(element);
        }
      return result;
    }
  };
} // namespace corotet

#endif
