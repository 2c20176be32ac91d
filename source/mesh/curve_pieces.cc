// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "curve_pieces.h"

#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/hilbert_curve.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    // The sorted cells of a rank, as a part of the sequence of all ranks'
    // cells.
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

      // The number of cells of all ranks before each of @p cuts.
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
       * Finds places before which there is the given amount of work, or of
       * cells; @p amounts are ascending. Of the places where the amount differs
       * by at most @p tolerance it takes the corner of the largest cube;
       * without any, the lowest place with at least this amount.
       */
      std::vector<CurvePlace>
      cuts(const std::vector<std::uint64_t> &amounts,
           const bool                        of_work,
           const std::uint64_t               tolerance) const
      {
        // Bisection: sets the bits of the place on the curve, then of the
        // number.
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
        // The other cuts are the highest places with less before them.
        for (std::size_t i = 0; i < cuts.size(); ++i)
          if (!is_found[i])
            ++cuts[i].number;
        return cuts;
      }

      // The index of the first cell of this rank that is not before @p cut.
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



    // The tolerance of a rank's work at either end of its piece, relative to
    // its work, so that pieces end between large cubes: lines of cells through
    // the thickness of a plate, which solvers need together, stay whole [-].
    constexpr double unequal_work = 0.005;



    // The first places of the pieces of all ranks but the first, with about
    // equal work, and a cell for each rank.
    std::vector<CurvePlace>
    beginnings(const Sequence &sequence, const unsigned int n_ranks)
    {
      const std::uint64_t        work = sequence.work(), n = sequence.n_cells();
      std::vector<std::uint64_t> amounts;
      for (unsigned int rank = 1; rank < n_ranks; ++rank)
        amounts.push_back(work * rank / n_ranks);
      std::vector<CurvePlace> cuts =
        sequence.cuts(amounts, true, unequal_work * work / n_ranks);
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
  } // namespace



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
} // namespace corotet
