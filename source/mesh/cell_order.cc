// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/hilbert_curve.h>

#include <deal.II/base/mpi.h>

#include <boost/sort/spreadsort/integer_sort.hpp>

#include <algorithm>
#include <compare>
#include <limits>
#include <numeric>
#include <utility>

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    // What cells are sorted by: the place on the curve and, for cells at the
    // same place, their numbers.
    struct CurvePlace
    {
      std::uint64_t on_curve;
      std::uint64_t number;

      auto
      operator<=>(const CurvePlace &) const = default;
    };



    // A cell of the part, or of one of several, and its place.
    struct PlacedCell
    {
      std::uint64_t on_curve;
      unsigned int  cell;
      unsigned int  part = 0;
    };



    // Of points of all ranks: the lowest coordinates, and the length of the
    // longest side.
    std::pair<dealii::Point<3>, double>
    box_of(const std::vector<dealii::Point<3>> &points, const MPI_Comm comm)
    {
      // Highest coordinates, and lowest ones with the other sign.
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



    // Of points of all ranks, on a curve through them all.
    std::vector<std::uint64_t>
    places_on_curve(const std::vector<dealii::Point<3>> &points,
                    const MPI_Comm                       comm)
    {
      const auto [lowest, extent] = box_of(points, comm);

      // The same unit of length in all directions: stretching a slender body
      // to a cube would make far cells neighbours on the curve.
      const double unit = extent > 0 ? ((1 << hilbert_bits) - 1) / extent : 0;
      std::vector<std::array<std::uint32_t, 3>> coordinates(points.size());
      for (std::size_t i = 0; i < points.size(); ++i)
        for (unsigned int d = 0; d < 3; ++d)
          coordinates[i][d] =
            static_cast<std::uint32_t>(unit * (points[i][d] - lowest[d]));
      return places_on_hilbert_curve(coordinates);
    }



    // @p number gives that of a cell.
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



    // The sorted cells of a rank, for questions about those of all ranks.
    class Sequence
    {
    public:
      Sequence(const std::vector<PlacedCell> &cells,
               const MeshPart                &part,
               const MPI_Comm                 comm)
        : cells(cells)
        , numbers(part.numbers)
        , comm(comm)
        , work_before(cells.size() + 1, 0)
      {
        for (std::size_t i = 0; i < cells.size(); ++i)
          work_before[i + 1] =
            work_before[i] + work_of(part.cells[cells[i].cell]);
      }

      std::uint64_t
      n_cells() const
      {
        return MPI::sum(std::uint64_t(cells.size()), comm);
      }

      std::uint64_t
      work() const
      {
        return MPI::sum(work_before.back(), comm);
      }

      // How many cells of all ranks are before each of @p cuts.
      std::vector<std::uint64_t>
      n_cells_before(const std::vector<CurvePlace> &cuts) const
      {
        std::vector<std::uint64_t> result;
        for (const CurvePlace &cut : cuts)
          result.push_back(position(cut));
        MPI::sum(result, comm, result);
        return result;
      }

      /**
       * Places that have so much before them, ascending as @p amounts: work, or
       * cells. Of those that differ from it by no more than @p tolerance, the
       * one that is the corner of the largest cube; without any, the lowest one
       * with at least so much.
       */
      std::vector<CurvePlace>
      cuts(const std::vector<std::uint64_t> &amounts,
           const bool                        of_work,
           const std::uint64_t               tolerance) const
      {
        // By bisection: bits of the place on the curve, then of the number.
        std::vector<CurvePlace> cuts(amounts.size(), CurvePlace{0, 0});
        std::vector<bool>       is_found(amounts.size(), false);
        for (const auto &[coordinate, n_bits] :
             {std::pair(&CurvePlace::on_curve, int(3 * hilbert_bits)),
              std::pair(&CurvePlace::number, 64)})
          for (int bit = n_bits - 1; bit >= 0; --bit)
            {
              std::vector<CurvePlace> trials = cuts;
              for (CurvePlace &trial : trials)
                trial.*coordinate |= std::uint64_t(1) << bit;
              std::vector<std::uint64_t> before;
              for (const CurvePlace &trial : trials)
                before.push_back(of_work ? work_before[position(trial)] :
                                           position(trial));
              MPI::sum(before, comm, before);
              for (std::size_t i = 0; i < cuts.size(); ++i)
                {
                  if (is_found[i])
                    continue;
                  is_found[i] = before[i] + tolerance >= amounts[i] &&
                                before[i] <= amounts[i] + tolerance;
                  if (is_found[i] || before[i] < amounts[i])
                    cuts[i] = trials[i];
                }
            }
        // The others are the highest places with less before them.
        for (std::size_t i = 0; i < cuts.size(); ++i)
          if (!is_found[i])
            ++cuts[i].number;
        return cuts;
      }

      // Of the first cell of this rank that is not before @p cut.
      std::size_t
      position(const CurvePlace &cut) const
      {
        return std::lower_bound(cells.begin(),
                                cells.end(),
                                cut,
                                [&](const PlacedCell &a, const CurvePlace &b) {
                                  return CurvePlace{a.on_curve,
                                                    numbers[a.cell]} < b;
                                }) -
               cells.begin();
      }

    private:
      const std::vector<PlacedCell>    &cells;
      const std::vector<std::uint64_t> &numbers;
      const MPI_Comm                    comm;
      std::vector<std::uint64_t>        work_before;
    };



    // Of the work of a rank, what it may have more or less at either end, so
    // that pieces end between large cubes: lines of cells through the thickness
    // of a plate, which solvers want together, stay whole [-].
    constexpr double inequality = 0.005;



    // Where the piece of each rank but the first begins, with about equal work,
    // and a cell for each rank.
    std::vector<CurvePlace>
    beginnings(const Sequence &sequence, const unsigned int n_ranks)
    {
      const std::uint64_t        work = sequence.work(), n = sequence.n_cells();
      std::vector<std::uint64_t> amounts;
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        amounts.push_back(work * rank / n_ranks);
      std::vector<CurvePlace> cuts =
        sequence.cuts(amounts, true, inequality * work / n_ranks);
      std::vector<std::uint64_t> first    = sequence.n_cells_before(cuts);
      bool                       is_moved = false;
      if (n < n_ranks)
        return cuts;
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        {
          const std::uint64_t least = rank == 1 ? 1 : first[rank - 2] + 1;
          const std::uint64_t wanted =
            std::max(least, std::min(first[rank - 1], n - (n_ranks - rank)));
          is_moved        = is_moved || wanted != first[rank - 1];
          first[rank - 1] = wanted;
        }
      return is_moved ? sequence.cuts(first, false, 0) : cuts;
    }



    // Of the sorted cells of this rank, those from the first on and before the
    // last that belong to the rank.
    struct Piece
    {
      std::size_t begin, end;
    };



    std::vector<Piece>
    pieces_by_owner(const MeshPart                &part,
                    const std::vector<PlacedCell> &cells,
                    const MPI_Comm                 comm)
    {
      const Sequence                sequence(cells, part, comm);
      const std::vector<CurvePlace> cuts =
        beginnings(sequence, MPI::n_mpi_processes(comm));
      std::vector<Piece> pieces{{0, cells.size()}};
      for (const CurvePlace &cut : cuts)
        {
          pieces.back().end = sequence.position(cut);
          pieces.push_back({pieces.back().end, cells.size()});
        }
      return pieces;
    }



    // For each other rank, the cells that belong to it and their places on the
    // curve.
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



    // Merges sorted sequences that stand one behind the other, each but the
    // first from a place of @p begins on.
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



    // Some sorted cells of a part and those that other ranks have sent, sorted.
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
    // Some thousand cells for each piece tell where the others are.
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
      pieces[piece_of_vertex[part.cells[c].vertices[0]]].push_back(c);
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
