// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_tangent_sweep_h
#define corotet_operators_tangent_sweep_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/cell_rule.h>
#include <corotet/operators/sweep.h>

/**
 * Tangents that vary inside a cell: with a rotation for each quadrature point,
 * or exact, with the derivative of the rotation. A first sweep stores what they
 * need of the displacement, a second one applies them.
 */
namespace corotet
{
  /// The derivative of the internal force.
  enum class Tangent
  {
    /// As if the rotations did not depend on the displacement: symmetric and
    /// positive semi-definite.
    frozen_rotation,
    /// Exact.
    consistent
  };

  /// Numbers per cell that linearization_sweep() stores.
  unsigned int
  linearization_size(const unsigned int n_points,
                     const Rotation     rotation,
                     const Tangent      tangent);

  /// Those of all owned batches.
  std::size_t
  linearization_size(const ReferenceElement &reference,
                     const CellBatches      &batches,
                     const Rotation          rotation,
                     const Tangent           tangent);

  /// First number of a batch. Those of curved ones follow those of all as if
  /// they were straight.
  template <bool is_curved>
  inline std::size_t
  linearization_start(const ReferenceElement &reference,
                      const CellBatches      &batches,
                      const Rotation          rotation,
                      const Tangent           tangent,
                      const unsigned int      batch)
  {
    const std::size_t size =
      linearization_size(n_points(reference.stiffness_rule), rotation, tangent);
    if constexpr (is_curved)
      {
        const CurvedBatches &curved = *batches.curved();
        return batch_size *
               (size * batches.n_owned_batches() +
                linearization_size(curved.n_points(), rotation, tangent) *
                  std::size_t(curved.index(batch)));
      }
    else
      return batch_size * size * batch;
  }

  /**
   * Stores the linearization of batches [first, end) at @p displacement, where
   * the cells' rotations must have been taken: for each batch
   * [number][lane]. Adds to @p n_clamped the cells where the
   * derivative of a rotation was clamped.
   */
  using LinearizationSweep = void (*)(const ReferenceElement &reference,
                                      const ElasticData      &data,
                                      const unsigned int      first,
                                      const unsigned int      end,
                                      const double           *displacement,
                                      double                 *linearization,
                                      unsigned int           &n_clamped);

  LinearizationSweep
  linearization_sweep(const Element  element,
                      const Rotation rotation,
                      const Tangent  tangent);

  struct TangentData
  {
    const ReferenceElement &reference;
    const ElasticData      &elastic;
    const double           *linearization;
    /// Multiplies the part of the tangent with frozen rotations.
    double frozen_factor;
    /// Null if there is no mass term.
    const CellMasses<double> *masses;
    double                    mass_factor;
  };

  /// Adds (K_T + (frozen_factor - 1) K_frozen + mass_factor M) source to
  /// @p sums.
  using TangentSweep = void (*)(const TangentData &data,
                                const unsigned int first,
                                const unsigned int end,
                                const double      *source,
                                double            *sums);

  TangentSweep
  tangent_sweep(const Element  element,
                const Rotation rotation,
                const Tangent  tangent);
} // namespace corotet

#endif
