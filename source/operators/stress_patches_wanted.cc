// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/stress_patches.h>

#include <algorithm>

// Recovery of stress in some cells only.
namespace corotet
{
  void
  StressPatches::find_wanted(const std::vector<unsigned int> &cells)
  {
    Vector wanted;
    nodes.initialize_vector(wanted);
    for (const unsigned int c : cells)
      for (const unsigned int n : nodes.cell_nodes(c))
        wanted.local_element(std::size_t(6) * n) = 1;
    wanted.compress(dealii::VectorOperation::add);
    wanted.update_ghost_values();
    is_wanted.resize(nodes.n_local());
    for (unsigned int n = 0; n < nodes.n_local(); ++n)
      is_wanted[n] = wanted.local_element(std::size_t(6) * n) != 0;
  }

  bool
  StressPatches::wants_any(const std::vector<unsigned int> &cells) const
  {
    return std::any_of(cells.begin(), cells.end(), [&](const unsigned int c) {
      const auto of_cell = nodes.cell_nodes(c);
      return std::any_of(of_cell.begin(),
                         of_cell.end(),
                         [&](const unsigned int n) { return wants(n); });
    });
  }

  void
  StressPatches::find_cells_read()
  {
    read = samples.cells_for_others();
    for (const Patch &patch : patches)
      for (const StressFit &fit : patch.fits)
        for (const unsigned int c : fit.cells)
          if (c < discretization.n_local_cells())
            read.push_back(c);
    std::sort(read.begin(), read.end());
    read.erase(std::unique(read.begin(), read.end()), read.end());
  }
} // namespace corotet
