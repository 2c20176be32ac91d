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
   * point: by boxes around pieces of the cells and of the nodes, whose numbers
   * follow a curve through the body. A search looks at the boxes, some 64 times
   * fewer than cells, and at the pieces in those that count.
   *
   * @p discretization must outlive this object. No member is collective.
   */
  class NearbyCells
  {
  public:
    explicit NearbyCells(const Discretization &discretization);

    /// Owned cells, ascending, among them all where PointSearch finds @p x [m],
    /// and those of whose barycentric coordinates, continued beyond the faces
    /// from its middle, none is below -@p outside.
    std::vector<unsigned int>
    cells(const dealii::Point<3> &x, const double outside = 0) const;

    /// From @p x to the nearest owned node [m]; infinity if there is none.
    double
    distance_to_nodes(const dealii::Point<3> &x) const;

    /// Owned nodes, ascending, that are no farther from @p x than @p distance
    /// [m].
    std::vector<unsigned int>
    nodes(const dealii::Point<3> &x, const double distance) const;

  private:
    /// Around cells or nodes with consecutive numbers.
    struct Box
    {
      Box();

      void
      include(const dealii::Point<3> &x);

      void
      include(const Box &other);

      /// Makes it larger by @p by [m] in all directions.
      void
      widen(const dealii::Tensor<1, 3> &by);

      /// Square of the distance from @p x [m^2]; 0 inside.
      double
      distance_square(const dealii::Point<3> &x) const;

      dealii::Point<3> lower, upper;
    };

    /// With the longest sides of boxes of cells in it.
    struct CellPiece
    {
      Box                  box;
      dealii::Tensor<1, 3> sides;
    };

    /// Where x may be for PointSearch to find it, but for a negligible part of
    /// the sides, and for cells().
    Box
    box_of_cell(const unsigned int cell) const;

    const Discretization               &discretization;
    const std::vector<dealii::Point<3>> map_nodes;
    std::vector<CellPiece>              cell_pieces;
    std::vector<Box>                    node_pieces;
  };
} // namespace corotet

#endif
