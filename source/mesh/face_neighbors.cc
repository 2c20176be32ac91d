// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/face_neighbors.h>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <utility>

namespace corotet
{
  namespace
  {
    // A face of a cell, in a list of its lowest vertex.
    struct CellFace
    {
      unsigned int middle, highest;
      // Four times the cell's number, plus the number of the face in it.
      unsigned int number;
    };



    // Calls action(lowest vertex, face, is_even) for each face of a cell.
    // is_even tells that an even permutation of the ascending vertices is
    // counter-clockwise seen from outside of the cell.
    template <typename Action>
    void
    for_each_face(const std::array<unsigned int, 4> &vertices,
                  const unsigned int                 cell,
                  const Action                      &action)
    {
      // The corners sorted by their vertices.
      std::array<unsigned int, 4> k{{0, 1, 2, 3}};
      bool                        is_odd = false;
      for (const auto &[i, j] : {std::pair(0, 1),
                                 std::pair(2, 3),
                                 std::pair(0, 2),
                                 std::pair(1, 3),
                                 std::pair(1, 2)})
        if (vertices[k[i]] > vertices[k[j]])
          {
            std::swap(k[i], k[j]);
            is_odd = !is_odd;
          }
      const unsigned int a = vertices[k[0]], b = vertices[k[1]],
                         c = vertices[k[2]], d = vertices[k[3]];
      // The face opposite to corner i has the number 3 - i.
      action(a, CellFace{b, c, 4 * cell + 3 - k[3]}, is_odd);
      action(a, CellFace{b, d, 4 * cell + 3 - k[2]}, !is_odd);
      action(a, CellFace{c, d, 4 * cell + 3 - k[1]}, is_odd);
      action(b, CellFace{c, d, 4 * cell + 3 - k[0]}, !is_odd);
    }



    [[noreturn]] void
    refuse_overlap(const MeshCells   &mesh,
                   const Triangle    &triangle,
                   const std::string &origin)
    {
      unsigned int n_cells = 0;
      for (const MeshCells::Cell &cell : mesh.cells)
        for_each_face(
          cell.vertices,
          0,
          [&](const unsigned int lowest, const CellFace &face, const bool) {
            n_cells +=
              Triangle{{lowest, face.middle, face.highest}} == triangle ? 1 : 0;
          });
      refuse_mesh(
        origin,
        fmt::format("cells overlap: the triangle with the centre {} is a face "
                    "of {} cells{}; at most two may share it, one on each side",
                    position(centre(mesh, triangle)),
                    n_cells,
                    n_cells == 2 ? " on the same side" : ""));
    }



    // Finds equal faces at one vertex, by a hash table that grows as needed.
    class FaceTable
    {
    public:
      // Starts a new vertex with so many faces.
      void
      start(const std::size_t n_faces)
      {
        if (2 * n_faces > slots.size())
          slots.assign(std::bit_ceil(2 * n_faces), {});
        mask = std::bit_ceil(2 * n_faces) - 1;
        ++round;
      }

      // The index of the first face with these vertices, which is @p index if
      // there was none before.
      std::size_t
      find_or_add(const std::vector<CellFace> &faces, const std::size_t index)
      {
        const CellFace &face = faces[index];
        for (std::size_t i =
               (face.middle * 2654435761u ^ face.highest * 2246822519u) >> 7;
             ;
             ++i)
          {
            Slot &slot = slots[i & mask];
            if (slot.round != round)
              {
                slot = {round, index};
                return index;
              }
            const CellFace &other = faces[slot.index];
            if (other.middle == face.middle && other.highest == face.highest)
              return slot.index;
          }
      }

    private:
      struct Slot
      {
        // The round in which the slot was filled.
        std::uint64_t round = 0;
        std::size_t   index = 0;
      };

      std::vector<Slot> slots;
      std::size_t       mask  = 0;
      std::uint64_t     round = 0;
    };



    // Sets the neighbors of faces that have none. If a face of two cells is not
    // allowed, calls refuse(its vertices, one cell, the other), and if that
    // returns, all faces with the same lowest vertex get no neighbors.
    template <typename Refuse>
    void
    match_faces(const MeshCells   &mesh,
                const unsigned int none,
                CellNeighbors     &neighbors,
                const Refuse      &refuse)
    {
      // Calls action(lowest vertex, face, is_even) for faces without neighbor.
      const auto for_each_open_face = [&](const auto &action) {
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (std::find(neighbors[c].begin(), neighbors[c].end(), none) !=
              neighbors[c].end())
            for_each_face(mesh.cells[c].vertices,
                          c,
                          [&](const unsigned int lowest,
                              const CellFace    &face,
                              const bool         even) {
                            if (neighbors[c][face.number % 4] == none)
                              action(lowest, face, even);
                          });
      };
      // Faces are listed at their lowest vertices, a few at each.
      std::vector<std::size_t> begin(mesh.vertices.size() + 1, 0);
      for_each_open_face([&](const unsigned int lowest,
                             const CellFace &,
                             const bool) { ++begin[lowest + 1]; });
      std::partial_sum(begin.begin(), begin.end(), begin.begin());
      std::vector<CellFace>    faces(begin.back());
      std::vector<bool>        is_even(begin.back());
      std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
      for_each_open_face(
        [&](const unsigned int lowest, const CellFace &face, const bool even) {
          is_even[next[lowest]] = even;
          faces[next[lowest]++] = face;
        });

      const auto cell_behind = [&](const CellFace &face) -> unsigned int & {
        return neighbors[face.number / 4][face.number % 4];
      };
      FaceTable table;
      for (unsigned int v = 0; v < mesh.vertices.size(); ++v)
        {
          bool is_wrong = false;
          table.start(begin[v + 1] - begin[v]);
          for (std::size_t i = begin[v]; i < begin[v + 1]; ++i)
            {
              const std::size_t j = table.find_or_add(faces, i);
              if (j == i)
                continue;
              const unsigned int c = faces[i].number / 4,
                                 d = faces[j].number / 4;
              if (cell_behind(faces[j]) != none || is_even[i] == is_even[j])
                {
                  refuse({{v, faces[i].middle, faces[i].highest}}, c, d);
                  is_wrong = true;
                }
              cell_behind(faces[i]) = d;
              cell_behind(faces[j]) = c;
            }
          if (is_wrong)
            for (std::size_t i = begin[v]; i < begin[v + 1]; ++i)
              cell_behind(faces[i]) = none;
        }
    }
  } // namespace



  CellNeighbors
  find_neighbors(const MeshCells                                 &mesh,
                 const unsigned int                               none,
                 const std::string                               &origin,
                 const std::function<bool(const unsigned int c)> &is_owned,
                 CellNeighbors                                    known)
  {
    known.resize(mesh.cells.size(), {{none, none, none, none}});
    match_faces(mesh,
                none,
                known,
                [&](const Triangle    &triangle,
                    const unsigned int a,
                    const unsigned int b) {
                  if (is_owned(a) || is_owned(b))
                    refuse_overlap(mesh, triangle, origin);
                });
    return known;
  }



  CellNeighbors
  undisputed_neighbors(const MeshCells &mesh, const unsigned int none)
  {
    CellNeighbors neighbors(mesh.cells.size(), {{none, none, none, none}});
    match_faces(mesh,
                none,
                neighbors,
                [](const Triangle &, const unsigned int, const unsigned int) {
                });
    return neighbors;
  }
} // namespace corotet
