// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_nearby_cells_h
#define corotet_discretization_nearby_cells_h

#include <corotet/discretization/discretization.h>

#include <vector>

namespace corotet
{
  /**
   * Finds the few owned cells and nodes of the body at rest that are near a
   * point, by boxes around pieces of consecutive cells or nodes, whose numbers
   * follow a curve through the body. A search checks the boxes, some 64 times
   * fewer than cells, and then the cells or nodes of the pieces nearby.
   *
   * @p discretization must outlive this object. No member is collective.
   */
  class NearbyCells
  {
  public:
    explicit NearbyCells(const Discretization &discretization);

    /// Owned cells in ascending order: all cells where PointSearch may find @p
    /// x [m] or where none of its barycentric coordinates, continued beyond the
    /// faces from the middle of the cell, is below -@p outside, and some more.
    std::vector<unsigned int>
    cells(const dealii::Point<3> &x, const double outside = 0) const;

    /// The distance from @p x to the nearest owned node [m]; infinity if there
    /// is none.
    double
    distance_to_nodes(const dealii::Point<3> &x) const;

    /// The owned nodes, in ascending order, that are no farther from @p x than
    /// @p distance [m].
    std::vector<unsigned int>
    nodes(const dealii::Point<3> &x, const double distance) const;

  private:
    /// A box around cells or nodes with consecutive numbers.
    struct Box
    {
      Box();

      void
      include(const dealii::Point<3> &x);

      void
      include(const Box &other);

      /// Makes the box larger by @p by [m] in all directions.
      void
      widen(const dealii::Tensor<1, 3> &by);

      /// The square of the distance of @p x from the box [m^2]; 0 inside.
      double
      distance_square(const dealii::Point<3> &x) const;

      dealii::Point<3> lower, upper;
    };

    /// The box of a piece of cells, and the longest sides of its cells' boxes.
    struct CellPiece
    {
      Box                  box;
      dealii::Tensor<1, 3> sides;
    };

    /// The box of the points that PointSearch may find in a cell, up to a
    /// negligible part of its sides; cells() also needs it.
    Box
    box_of_cell(const unsigned int cell) const;

    const Discretization               &discretization;
    const std::vector<dealii::Point<3>> map_nodes;
    std::vector<CellPiece>              cell_pieces;
    std::vector<Box>                    node_pieces;
  };
} // namespace corotet

#endif
