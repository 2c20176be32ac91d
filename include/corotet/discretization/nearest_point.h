// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_nearest_point_h
#define corotet_discretization_nearest_point_h

#include <corotet/discretization/discretization.h>
#include <corotet/discretization/nearby_cells.h>

#include <optional>

namespace corotet
{
  /**
   * The point of the body at rest that is nearest to @p x [m], if @p x is so
   * near that a point of the surface may be meant: outside of a straight cell
   * with the same vertices by less than a fifth of its heights. (Points on the
   * exact surface of a curved part are a little outside of its cells.) Returns
   * @p x itself if a cell contains it, that of the lowest rank if several
   * points are equally near, and nothing if no cell is near. Collective.
   */
  std::optional<dealii::Point<3>>
  nearest_point(const Discretization   &discretization,
                const NearbyCells      &nearby,
                const dealii::Point<3> &x);
} // namespace corotet

#endif
