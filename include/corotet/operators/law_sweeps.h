// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_law_sweeps_h
#define corotet_operators_law_sweeps_h

#include <corotet/material/law_at_points.h>
#include <corotet/operators/point_operations.h>

/**
 * The loops over cells for a law at points.
 */
namespace corotet
{
  namespace internal
  {
    /// The law of a sweep. It is a copy, so that its parameters may stay in
    /// registers.
    template <Law L>
    COROTET_ALWAYS_INLINE L
    law_of(const ElasticData &data)
    {
      return *static_cast<const L *>(data.law);
    }

    /// The force f_i = sum_q w_q P(F_q) grad N_i.
    template <Law L>
    struct ForceOfLaw
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *sums)
      {
        const L         law  = law_of<L>(points.data);
        const LameLanes lame = points.lame();
        constexpr bool  has_counts =
          std::same_as<decltype(law.stress(lame,
                                           std::declval<const Tensor2Lanes &>(),
                                           std::declval<Tensor2Lanes &>())),
                       PolarLanes>;
        typename Points::NodalValues u, f{};
        PolarLanes                   found;
        points.load(displacement, u);
        const auto stress =
          [&](const unsigned int, const Tensor2Lanes &H, Tensor2Lanes &P) {
            if constexpr (has_counts)
              found |= law.stress(lame, H, P);
            else
              law.stress(lame, H, P);
          };
        points.integrate(u, f, stress);
        if constexpr (has_counts)
          points.data.counts.add(found, points.constants);
        points.add_to(sums, f);
      }
    };

    template <Law L>
    struct StateOfLaw
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *)
      {
        const L         law  = law_of<L>(points.data);
        const LameLanes lame = points.lame();
        points.add_state(displacement, [&](const Tensor2Lanes &H) {
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

    template <Law L, Tangent tangent>
    constexpr LinearizationSize size_of_linearization{0, n_stored<L, tangent>};

    template <Law L, Tangent tangent>
    struct LinearizationOfLaw
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *displacement, double *)
      {
        const L                      law  = law_of<L>(points.data);
        const LameLanes              lame = points.lame();
        typename Points::NodalValues u;
        points.load(displacement, u);
        NumberWriter numbers = points.writer(size_of_linearization<L, tangent>);
        unsigned int clamped = 0;
        const auto linearize = [&](const unsigned int, const Tensor2Lanes &H) {
          NumberLanes<n_stored<L, tangent>> stored;
          if constexpr (tangent == Tangent::frozen_rotation)
            law.linearize_frozen(H, stored);
          else
            clamped |= law.linearize(lame, H, stored);
          numbers.write(stored);
        };
        points.for_each_point(u, linearize);
        points.count_clamped(clamped);
      }
    };

    template <Law L, Tangent tangent>
    struct TangentOfLaw
    {
      template <typename Points>
      static COROTET_ALWAYS_INLINE void
      apply(Points &points, const double *source, double *sums)
      {
        const L                      law    = law_of<L>(points.data);
        const LameLanes              lame   = points.lame();
        const double                 factor = points.data.frozen_factor;
        typename Points::NodalValues u, f;
        points.gather_with_matrices(source,
                                    LawWithFrozenForm<L> ? 0. : factor - 1.,
                                    u,
                                    f);
        points.load_geometry();
        NumberReader numbers = points.reader(size_of_linearization<L, tangent>);
        const auto   stress =
          [&](const unsigned int, const Tensor2Lanes &dF, Tensor2Lanes &dP) {
            NumberLanes<n_stored<L, tangent>> stored;
            numbers.read(stored);
            if constexpr (tangent == Tangent::frozen_rotation)
              law.frozen_derivative({factor * lame.lambda, factor * lame.mu},
                                    stored,
                                    dF,
                                    dP);
            else if constexpr (LawWithFrozenForm<L>)
              law.derivative(lame, factor, stored, dF, dP);
            else
              law.derivative(lame, stored, dF, dP);
          };
        points.integrate(u, f, stress);
        points.add_to(sums, f);
      }
    };

    template <Law L, Tangent tangent>
    TangentSweeps
    tangent_sweeps(const Element element)
    {
      return {size_of_linearization<L, tangent>,
              point_sweep<LinearizationOfLaw<L, tangent>>(element),
              point_sweep<TangentOfLaw<L, tangent>>(element)};
    }
  } // namespace internal

  /**
   * A Law as a MaterialLaw, with the kernels for all elements, which are
   * compiled where this is instantiated. Each law should be instantiated once,
   * in one source file.
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
      result.state = point_sweep<internal::StateOfLaw<L>>(element);
      if constexpr (is_linear_law<L>)
        {
          result.force       = force_sweep(element);
          result.force_scale = stiffness_scale(element);
        }
      else
        {
          result.force = point_sweep<internal::ForceOfLaw<L>>(element);
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
