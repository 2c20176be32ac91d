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
  /// The key for sorting cells: the place on the curve and, for cells at the
  /// same place, their numbers.
  struct CurvePlace
  {
    std::uint64_t on_curve;
    std::uint64_t number;

    auto
    operator<=>(const CurvePlace &) const = default;
  };

  /// A cell of a part, or of one of several parts, and its place on the curve.
  struct PlacedCell
  {
    std::uint64_t on_curve;
    unsigned int  cell;
    unsigned int  part = 0;
  };

  /// A range of this rank's sorted cells that belongs to one rank: from @p
  /// begin to before @p end.
  struct Piece
  {
    std::size_t begin, end;
  };

  /// The ranges of this rank's sorted cells for each rank, so that all ranks
  /// get pieces of the curve with about equal work, and a cell each.
  /// Collective.
  std::vector<Piece>
  pieces_by_owner(const MeshPart                &part,
                  const std::vector<PlacedCell> &cells,
                  const MPI_Comm                 comm);
} // namespace corotet

#endif
