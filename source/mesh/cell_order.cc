// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/hilbert_curve.h>

#include <deal.II/base/mpi.h>

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "curve_pieces.h"

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    // The box around the points of all ranks: its lowest coordinates, and the
    // length of its longest side.
    std::pair<dealii::Point<3>, double>
    box_of(const std::vector<dealii::Point<3>> &points, const MPI_Comm comm)
    {
      // The highest coordinates, and the lowest ones with the opposite sign.
      std::vector<double> bounds(6, -std::numeric_limits<double>::infinity());
      for (const dealii::Point<3> &x : points)
        for (unsigned int d = 0; d < 3; ++d)
          {
            bounds[d]     = std::max(bounds[d], x[d]);
            bounds[3 + d] = std::max(bounds[3 + d], -x[d]);
          }
      MPI::max(bounds, comm, bounds);
      dealii::Point<3> lowest;
      double           extent = 0;
      for (unsigned int d = 0; d < 3; ++d)
        {
          lowest[d] = -bounds[3 + d];
          extent    = std::max(extent, bounds[d] - lowest[d]);
        }
      return {lowest, extent};
    }



    // The places of points on a curve through the points of all ranks.
    std::vector<std::uint64_t>
    places_on_curve(const std::vector<dealii::Point<3>> &points,
                    const MPI_Comm                       comm)
    {
      const auto [lowest, extent] = box_of(points, comm);

      // The unit of length is the same in all directions: if a slender body
      // were stretched to a cube, distant cells would be neighbours on the
      // curve.
      const double unit = extent > 0 ? ((1 << hilbert_bits) - 1) / extent : 0;
      std::vector<std::uint64_t> places;
      places.reserve(points.size());
      for (const dealii::Point<3> &x : points)
        {
          std::array<std::uint32_t, 3> coordinates;
          for (unsigned int d = 0; d < 3; ++d)
            coordinates[d] =
              static_cast<std::uint32_t>(unit * (x[d] - lowest[d]));
          places.push_back(place_on_hilbert_curve(coordinates));
        }
      return places;
    }



    // Sorts cells by place, then by number. @p number gives the number of a
    // cell.
    template <typename Number>
    void
    sort_cells(std::vector<PlacedCell> &cells, const Number &number)
    {
      boost::sort::spreadsort::integer_sort(
        cells.begin(),
        cells.end(),
        [](const PlacedCell &a, const unsigned int shift) {
          return a.on_curve >> shift;
        },
        [](const PlacedCell &a, const PlacedCell &b) {
          return a.on_curve < b.on_curve;
        });
      for (auto begin = cells.begin(), end = begin; begin != cells.end();
           begin = end)
        {
          while (end != cells.end() && end->on_curve == begin->on_curve)
            ++end;
          if (end - begin > 1)
            std::sort(begin,
                      end,
                      [&](const PlacedCell &a, const PlacedCell &b) {
                        return number(a) < number(b);
                      });
        }
    }



    std::vector<PlacedCell>
    sorted_cells(const MeshPart &part, const MPI_Comm comm)
    {
      std::vector<dealii::Point<3>> centres(part.cells.size());
      for (unsigned int c = 0; c < centres.size(); ++c)
        for (const unsigned int v : part.cells[c].vertices)
          centres[c] += part.vertices[v] / 4.;
      const std::vector<std::uint64_t> on_curve =
        places_on_curve(centres, comm);

      std::vector<PlacedCell> cells;
      cells.reserve(centres.size());
      for (unsigned int c = 0; c < centres.size(); ++c)
        cells.push_back({on_curve[c], c});
      sort_cells(cells, [&](const PlacedCell &placed) {
        return part.numbers[placed.cell];
      });
      return cells;
    }



    // The messages for other ranks: the cells that belong to them and their
    // places on the curve.
    Messages
    cells_for_others(const MeshPart                &part,
                     const std::vector<PlacedCell> &cells,
                     const std::vector<Piece>      &pieces,
                     const unsigned int             my_rank)
    {
      Messages   messages;
      PartCutter cutter(part);
      for (unsigned int rank = 0; rank < pieces.size(); ++rank)
        {
          const auto [begin, end] = pieces[rank];
          if (rank == my_rank || begin == end)
            continue;
          std::vector<unsigned int>  moved;
          std::vector<std::uint64_t> on_curve;
          for (std::size_t i = begin; i < end; ++i)
            {
              moved.push_back(cells[i].cell);
              on_curve.push_back(cells[i].on_curve);
            }
          messages[rank] = packed(cutter.cut(moved));
          append_array(messages[rank], on_curve);
        }
      return messages;
    }



    // Merges sorted sequences that stand one behind the other; each sequence
    // but the first starts at one of @p begins.
    void
    merge_sequences(std::vector<PlacedCell>     &cells,
                    std::vector<std::size_t>     begins,
                    const std::vector<MeshPart> &parts)
    {
      const auto is_before = [&](const PlacedCell &a, const PlacedCell &b) {
        return CurvePlace{a.on_curve, parts[a.part].numbers[a.cell]} <
               CurvePlace{b.on_curve, parts[b.part].numbers[b.cell]};
      };
      begins.insert(begins.begin(), 0);
      begins.push_back(cells.size());
      while (begins.size() > 2)
        {
          std::vector<std::size_t> merged_begins;
          for (std::size_t i = 0; i + 1 < begins.size(); i += 2)
            {
              merged_begins.push_back(begins[i]);
              if (i + 2 < begins.size())
                std::inplace_merge(cells.begin() + begins[i],
                                   cells.begin() + begins[i + 1],
                                   cells.begin() + begins[i + 2],
                                   is_before);
            }
          merged_begins.push_back(cells.size());
          begins = std::move(merged_begins);
        }
    }



    // A part of some sorted cells of @p part and those that other ranks have
    // sent, all sorted.
    MeshPart
    sorted_part(MeshPart                &&part,
                std::vector<PlacedCell> &&cells,
                Messages                &&messages)
    {
      const unsigned int       degree = part.geometry_degree;
      std::vector<MeshPart>    parts;
      std::vector<std::size_t> begins;
      parts.push_back(std::move(part));
      for (auto &[rank, message] : messages)
        {
          std::size_t                position = 0;
          std::vector<std::uint64_t> on_curve;
          parts.push_back(unpacked(message, position));
          read_array(message, position, on_curve);
          message = {};
          begins.push_back(cells.size());
          for (unsigned int c = 0; c < on_curve.size(); ++c)
            cells.push_back(
              {on_curve[c], c, static_cast<unsigned int>(parts.size() - 1)});
        }
      merge_sequences(cells, begins, parts);
      std::vector<std::pair<unsigned int, unsigned int>> order;
      order.reserve(cells.size());
      for (const PlacedCell &placed : cells)
        order.emplace_back(placed.part, placed.cell);
      cells                  = {};
      MeshPart result        = merged(parts, order);
      result.geometry_degree = degree;
      return result;
    }
  } // namespace



  std::vector<std::vector<unsigned int>>
  pieces_of_curve(const MeshPart &part, const unsigned int n_pieces)
  {
    // A sample of some thousand cells for each piece tells where the pieces
    // end.
    constexpr std::size_t            n_samples = 4096;
    const std::vector<std::uint64_t> on_curve =
      places_on_curve(part.vertices, MPI_COMM_SELF);
    const std::size_t step =
      std::max<std::size_t>(1, part.cells.size() / (n_samples * n_pieces));
    std::vector<std::uint64_t> samples;
    for (std::size_t c = 0; c < part.cells.size(); c += step)
      samples.insert(samples.end(),
                     work_of(part.cells[c]),
                     on_curve[part.cells[c].vertices[0]]);
    std::sort(samples.begin(), samples.end());
    std::vector<std::uint64_t> cuts;
    for (unsigned int i = 1; i < n_pieces; ++i)
      cuts.push_back(samples[samples.size() * i / n_pieces]);

    std::vector<unsigned int> piece_of_vertex;
    piece_of_vertex.reserve(on_curve.size());
    for (const std::uint64_t place : on_curve)
      piece_of_vertex.push_back(
        std::upper_bound(cuts.begin(), cuts.end(), place) - cuts.begin());
    std::vector<std::vector<unsigned int>> pieces(n_pieces);
    for (auto &piece : pieces)
      piece.reserve(1.05 * part.cells.size() / n_pieces);
    for (unsigned int c = 0; c < part.cells.size(); ++c)
      {
        // A cell belongs to the piece of most of its vertices, or of the first
        // one.
        const auto  &v = part.cells[c].vertices;
        unsigned int p[4];
        for (unsigned int k = 0; k < 4; ++k)
          p[k] = piece_of_vertex[v[k]];
        unsigned int piece = p[0];
        if (p[0] != p[1] && p[0] != p[2] && p[0] != p[3])
          {
            if (p[1] == p[2] || p[1] == p[3])
              piece = p[1];
            else if (p[2] == p[3])
              piece = p[2];
          }
        pieces[piece].push_back(c);
      }
    return pieces;
  }



  void
  sort_along_curve(MeshPart &part, const MPI_Comm comm)
  {
    std::vector<PlacedCell> cells = sorted_cells(part, comm);
    if (MPI::n_mpi_processes(comm) == 1)
      {
        std::vector<unsigned int> order;
        order.reserve(cells.size());
        for (const PlacedCell &placed : cells)
          order.push_back(placed.cell);
        part = PartCutter(part).cut(order);
      }
    else
      {
        const unsigned int       my_rank = MPI::this_mpi_process(comm);
        const std::vector<Piece> pieces  = pieces_by_owner(part, cells, comm);
        Messages                 received =
          exchange_messages(cells_for_others(part, cells, pieces, my_rank),
                            comm);
        const auto [begin, end] = pieces[my_rank];
        cells.resize(end);
        cells.erase(cells.begin(), cells.begin() + begin);
        part =
          sorted_part(std::move(part), std::move(cells), std::move(received));
      }

    const auto [first, n] =
      MPI::partial_and_total_sum(std::uint64_t(part.cells.size()), comm);
    std::iota(part.numbers.begin(), part.numbers.end(), first);
  }
} // namespace corotet
