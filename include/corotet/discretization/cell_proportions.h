// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_cell_proportions_h
#define corotet_discretization_cell_proportions_h

#include <corotet/discretization/discretization.h>

#include <deal.II/base/point.h>

#include <string>

namespace corotet
{
  /**
   * How far the cells of a body are from regular tetrahedra.
   *
   * The regular tetrahedron becomes a cell by stretching it in three
   * directions by s1 >= s2 >= s3 [-]: s2 / s3 of a flat cell is large, and
   * s1 / s2 of a stretched one. Slivers are flat.
   */
  struct CellProportions
  {
    /// The ratio above which a cell counts as flat, or as stretched.
    static constexpr double limit = 4;
    /// The share of such cells up to which a body counts as well-shaped.
    static constexpr double few = 0.1;

    double share_flat      = 0;
    double share_stretched = 0;
    /// The geometric mean over the cells of the larger of the two ratios.
    double mean_ratio = 1;
    /// The largest ratio, and the centre of its cell at rest [m].
    double           largest_ratio = 1;
    dealii::Point<3> place;

    /// Whether more than a few cells are flat, or stretched.
    bool
    are_poor() const
    {
      return share_flat > few || share_stretched > few;
    }

    /// The text "12 % of the cells are flat, 3 % stretched (by more than 4;
    /// most by 17, at (x, y, z))".
    std::string
    text() const;
  };

  /// The proportions of all cells of all ranks, with straight edges between
  /// their vertices. Collective.
  CellProportions
  cell_proportions(const Discretization &discretization);
} // namespace corotet

#endif
