// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/elastic_sweeps.h>

namespace corotet
{
  std::size_t
  LinearizationSize::of_batches(const ReferenceElement &reference,
                                const CellBatches      &batches) const
  {
    std::size_t size = std::size_t(batches.n_batches()) *
                       of_straight_cell(n_points(reference.stiffness_rule));
    if (const CurvedBatches *curved = batches.curved())
      size += curved->n_batches() * of_curved_cell(curved->n_points());
    return batch_size * size;
  }
} // namespace corotet
