// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_curve_pieces_h
#define corotet_mesh_curve_pieces_h

#include <corotet/mesh/mesh_part.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace corotet
{
  /// What cells are sorted by: the place on the curve and, for cells at the
  /// same place, their numbers.
  struct CurvePlace
  {
    std::uint64_t on_curve;
    std::uint64_t number;

    auto
    operator<=>(const CurvePlace &) const = default;
  };

  /// A cell of the part, or of one of several, and its place.
  struct PlacedCell
  {
    std::uint64_t on_curve;
    unsigned int  cell;
    unsigned int  part = 0;
  };

  /// Of the sorted cells of this rank, those from the first on and before the
  /// last that belong to one rank.
  struct Piece
  {
    std::size_t begin, end;
  };

  /// What the cells of this rank, sorted, have for each rank, so that all get
  /// pieces of the curve with about equal work, and a cell each. Collective.
  std::vector<Piece>
  pieces_by_owner(const MeshPart                &part,
                  const std::vector<PlacedCell> &cells,
                  const MPI_Comm                 comm);
} // namespace corotet

#endif
