// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_elastic_sweeps_h
#define corotet_operators_elastic_sweeps_h

#include <corotet/operators/cell_rule.h>
#include <corotet/operators/sweep.h>
#include <corotet/operators/tangent.h>

namespace corotet
{
  /// The count of numbers that a linearization keeps.
  struct LinearizationSize
  {
    unsigned int per_cell  = 0;
    unsigned int per_point = 0;
    /// Whether straight cells keep no numbers of their points.
    bool only_curved_have_points = false;

    constexpr std::size_t
    of_curved_cell(const unsigned int n_points) const
    {
      return per_cell + per_point * n_points;
    }

    constexpr std::size_t
    of_straight_cell(const unsigned int n_points) const
    {
      return of_curved_cell(only_curved_have_points ? 0 : n_points);
    }

    /// The count for all batches.
    std::size_t
    of_batches(const ReferenceElement &reference,
               const CellBatches      &batches) const;
  };

  /// Place of the first number of a batch. The numbers of curved batches follow
  /// those of all batches, which are placed as if they were straight.
  template <bool is_curved>
  inline std::size_t
  linearization_start(const ElasticData      &data,
                      const LinearizationSize size,
                      const unsigned int      batch)
  {
    const std::size_t straight =
      size.of_straight_cell(n_points(data.reference.stiffness_rule));
    std::size_t start = straight * batch;
    if constexpr (is_curved)
      {
        const CurvedBatches &curved = *data.batches.curved();
        start                       = straight * data.batches.n_batches() +
                size.of_curved_cell(curved.n_points()) * curved.index(batch);
      }
    return batch_size * start;
  }

  /**
   * A tangent that varies inside a cell: a first sweep keeps numbers that
   * depend on the displacement, a second one adds (K_T + (frozen_factor - 1)
   * K_frozen + mass_factor M) source to the sums. Null where the tangent is
   * that of the cells' frozen rotations.
   */
  struct TangentSweeps
  {
    LinearizationSize size      = {};
    ElasticSweep      linearize = nullptr;
    ElasticSweep      apply     = nullptr;
    /// Whether the second sweep reads the displacement of the first one, too.
    bool needs_displacement = false;
  };

  /**
   * The loops of a law over cells, for one element. Sources are displacements,
   * except that of TangentSweeps::apply.
   */
  struct ElasticSweeps
  {
    /// The internal force, in units of force_scale.
    ElasticSweep force       = nullptr;
    double       force_scale = 1;
    /// Whether the force sweep computes the cells' rotations, too.
    bool force_rotates = false;
    /// Computes the elastic energy and det F. It has no sums.
    ElasticSweep  state      = nullptr;
    TangentSweeps consistent = {};
    TangentSweeps frozen     = {};
    /// The value for ElasticData::law.
    const void *law = nullptr;

    const TangentSweeps &
    tangent(const Tangent tangent) const
    {
      return tangent == Tangent::consistent ? consistent : frozen;
    }
  };
} // namespace corotet

#endif
