// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_cell_rule_h
#define corotet_operators_cell_rule_h

#include <corotet/discretization/curved_batches.h>

/**
 * The points where the quadrature kernel evaluates a batch of cells: for
 * straight cells those of a ReferenceElement::PointValues, for curved ones
 * those of a CurvedRule. In both, derivatives by xi become those by the
 * coordinates that the cell has at its centre.
 */
namespace corotet
{
  /// The points of a batch with curved cells.
  struct CurvedRule
  {
    const ReferenceElement::PointValues &shapes;
    /// The numbers of CurvedBatches::numbers().
    const double *numbers;

    COROTET_ALWAYS_INLINE Simd<double>
    number(const unsigned int q, const unsigned int k) const
    {
      return load_aligned<batch_size>(
        numbers + (CurvedBatches::n_numbers * std::size_t(q) + k) * batch_size);
    }
  };

  /// Whether gradients of the coordinates, and weights, are the same in all
  /// cells and points except for a factor.
  template <typename Rule>
  inline constexpr bool is_of_straight_cells =
    std::is_same_v<Rule, ReferenceElement::PointValues>;

  /// The rule of a batch; is_curved (std::true_type or std::false_type) tells
  /// which kind.
  template <typename IsCurved>
  COROTET_ALWAYS_INLINE decltype(auto)
  cell_rule(const IsCurved,
            const ReferenceElement &reference,
            const CellBatches      &batches,
            const unsigned int      batch)
  {
    if constexpr (IsCurved::value)
      return CurvedRule{batches.curved()->shapes(),
                        batches.curved()->template numbers<double>(batch)};
    else
      return (reference.stiffness_rule);
  }

  COROTET_ALWAYS_INLINE unsigned int
  n_points(const ReferenceElement::PointValues &rule)
  {
    return rule.weights.size();
  }

  COROTET_ALWAYS_INLINE unsigned int
  n_points(const CurvedRule &rule)
  {
    return rule.shapes.weights.size();
  }

  /// Share of point @p q in the volume.
  COROTET_ALWAYS_INLINE double
  weight_at(const ReferenceElement::PointValues &rule, const unsigned int q)
  {
    return rule.weights[q];
  }

  COROTET_ALWAYS_INLINE Simd<double>
                        weight_at(const CurvedRule &rule, const unsigned int q)
  {
    return rule.number(q, 9);
  }

  /// The orbits that the points consist of.
  COROTET_ALWAYS_INLINE const std::vector<PointOrbit> &
  orbits_of(const ReferenceElement::PointValues &rule)
  {
    return rule.orbits;
  }

  COROTET_ALWAYS_INLINE const std::vector<PointOrbit>                             &
  orbits_of(const CurvedRule &rule)
  {
    return rule.shapes.orbits;
  }

  /// Derivatives by xi at point @p q, [node][k].
  COROTET_ALWAYS_INLINE const double *
  derivatives_at(const ReferenceElement::PointValues &rule,
                 const unsigned int                   q)
  {
    return &rule.gradients(q, 0, 0);
  }

  COROTET_ALWAYS_INLINE const double *
  derivatives_at(const CurvedRule &rule, const unsigned int q)
  {
    return &rule.shapes.gradients(q, 0, 0);
  }

  /// Derivatives [a][k] by xi become those by the centre's coordinates.
  COROTET_ALWAYS_INLINE void
  to_centre(const ReferenceElement::PointValues &,
            const unsigned int,
            Simd<double> (&)[3][3])
  {}

  COROTET_ALWAYS_INLINE void
  to_centre(const CurvedRule  &rule,
            const unsigned int q,
            Simd<double> (&by_xi)[3][3])
  {
    Simd<double> result[3][3]{};
    static_for<9>([&](auto kl) {
      const Simd<double> m = rule.number(q, kl);
      static_for<3>([&](auto a) { result[a][kl % 3] += by_xi[a][kl / 3] * m; });
    });
    static_for<9>([&](auto i) { by_xi[i / 3][i % 3] = result[i / 3][i % 3]; });
  }

  /// The transpose of to_centre().
  COROTET_ALWAYS_INLINE void
  from_centre(const ReferenceElement::PointValues &,
              const unsigned int,
              Simd<double> (&)[3][3])
  {}

  COROTET_ALWAYS_INLINE void
  from_centre(const CurvedRule  &rule,
              const unsigned int q,
              Simd<double> (&by_xi)[3][3])
  {
    Simd<double> result[3][3]{};
    static_for<9>([&](auto kl) {
      const Simd<double> m = rule.number(q, kl);
      static_for<3>([&](auto a) { result[a][kl / 3] += by_xi[a][kl % 3] * m; });
    });
    static_for<9>([&](auto i) { by_xi[i / 3][i % 3] = result[i / 3][i % 3]; });
  }
} // namespace corotet

#endif
