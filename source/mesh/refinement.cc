// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/refinement.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "tetrahedron_cut.h"

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;
    using dealii::Point;

    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;



    // A part of a curved cell: the cell's number among the curved ones, and
    // the vertices of the part in the reference tetrahedron.
    struct CurvedPiece
    {
      unsigned int            curve;
      std::array<Point<3>, 4> vertices;
    };



    // The edges of the cells, and their middles, which are appended to the
    // vertices of a part.
    class Middles
    {
    public:
      explicit Middles(MeshPart &part)
        : part(part)
        , n_vertices(part.vertices.size())
        , first(n_vertices, none)
      {}

      // The vertex in the middle of an edge, which is made at the first call.
      unsigned int
      between(const unsigned int u, const unsigned int v)
      {
        const auto [a, b] = ascending_ends(u, v);
        for (unsigned int i = first[a]; i != none; i = edges[i].next)
          if (edges[i].high == b)
            return n_vertices + i;
        edges.push_back({a, b, first[a]});
        first[a] = edges.size() - 1;
        part.vertices.push_back((part.vertices[a] + part.vertices[b]) / 2.);
        return part.vertices.size() - 1;
      }

      // Gives each middle a number by which all ranks know it: the ends of an
      // edge decide which rank assigns it.
      void
      number(const MPI_Comm comm)
      {
        struct Asked
        {
          std::uint64_t low, high;
          unsigned int  edge, rank;
        };
        struct Given
        {
          std::uint64_t number;
          unsigned int  edge;
        };
        const unsigned int n_ranks = MPI::n_mpi_processes(comm);
        std::map<unsigned int, std::vector<Asked>> asked;
        std::uint64_t                              highest = 0;
        for (const std::uint64_t number : part.vertex_numbers)
          highest = std::max(highest, number);
        highest = MPI::max(highest, comm);
        for (unsigned int i = 0; i < edges.size(); ++i)
          {
            std::uint64_t low  = part.vertex_numbers[edges[i].low];
            std::uint64_t high = part.vertex_numbers[edges[i].high];
            if (low > high)
              std::swap(low, high);
            asked[(low + high) % n_ranks].push_back(
              {low, high, i, MPI::this_mpi_process(comm)});
          }
        std::vector<Asked> list;
        for (const auto &[rank, questions] : exchange_arrays(asked, comm))
          list.insert(list.end(), questions.begin(), questions.end());
        std::sort(list.begin(), list.end(), [](const Asked &a, const Asked &b) {
          return std::tie(a.low, a.high) < std::tie(b.low, b.high);
        });
        std::uint64_t n = 0;
        for (std::size_t i = 0; i < list.size(); ++i)
          n += is_first(list, i) ? 1 : 0;
        std::uint64_t next =
          highest + MPI::partial_and_total_sum(n, comm).first;
        std::map<unsigned int, std::vector<Given>> given;
        for (std::size_t i = 0; i < list.size(); ++i)
          {
            next += is_first(list, i) ? 1 : 0;
            given[list[i].rank].push_back({next, list[i].edge});
          }
        part.vertex_numbers.resize(part.vertices.size());
        for (const auto &[rank, answers] : exchange_arrays(given, comm))
          for (const auto &[number, edge] : answers)
            part.vertex_numbers[n_vertices + edge] = number;
      }

    private:
      // Whether an entry has another edge than the entry before.
      template <typename Asked>
      static bool
      is_first(const std::vector<Asked> &list, const std::size_t i)
      {
        return i == 0 || list[i].low != list[i - 1].low ||
               list[i].high != list[i - 1].high;
      }

      struct Edge
      {
        unsigned int low, high;
        // The next edge with the same lower end.
        unsigned int next;
      };

      MeshPart                 &part;
      const unsigned int        n_vertices;
      std::vector<unsigned int> first;
      std::vector<Edge>         edges;
    };



    // The number of the shortest diagonal of the octahedron in the middle.
    unsigned int
    shortest_diagonal(const MeshPart                     &part,
                      const std::array<unsigned int, 10> &vertices)
    {
      constexpr unsigned int ends[3][2] = {{6, 8}, {5, 7}, {4, 9}};
      unsigned int           shortest   = 0;
      double                 length = std::numeric_limits<double>::infinity();
      for (unsigned int i = 0; i < 3; ++i)
        {
          const double distance = part.vertices[vertices[ends[i][0]]].distance(
            part.vertices[vertices[ends[i][1]]]);
          // Diagonals of a box have equal lengths; round-off must not choose.
          if (distance < (1 - 1e-8) * length)
            {
              shortest = i;
              length   = distance;
            }
        }
      return shortest;
    }



    // Passes names of parts on to the children; @p diagonals tells how each
    // cell was cut.
    void
    refine_names(MeshPart &part, const std::vector<unsigned char> &diagonals)
    {
      std::vector<CellPart> faces, edges;
      for (const auto &[c, f, id] : part.faces)
        for (const auto &[child, g] : tetrahedron_cuts()[diagonals[c]].faces[f])
          faces.push_back({8 * c + child, g, id});
      // Child k has vertex k of the cell as its own vertex k, and the halves of
      // the edges at this vertex as edges with the same numbers.
      for (const auto &[c, e, id] : part.edges)
        for (const unsigned int k : ends_of_edges[e])
          edges.push_back({8 * c + k, e, id});
      for (CellPart &corner : part.corners)
        corner.cell = 8 * corner.cell + corner.number;
      part.faces = std::move(faces);
      part.edges = std::move(edges);
      for (auto *list : {&part.faces, &part.edges, &part.corners})
        std::stable_sort(list->begin(),
                         list->end(),
                         [](const CellPart &a, const CellPart &b) {
                           return a.cell < b.cell;
                         });
    }



    // Refines all cells once. Curved cells have indices in @p pieces, which
    // become the pieces of their children.
    void
    refine_once(MeshPart                 &part,
                std::vector<CurvedPiece> &pieces,
                const MPI_Comm            comm)
    {
      Middles                      middles(part);
      std::vector<MeshCells::Cell> cells;
      std::vector<std::uint64_t>   numbers;
      std::vector<CurvedPiece>     new_pieces;
      std::vector<unsigned char>   diagonals;
      cells.reserve(8 * part.cells.size());
      numbers.reserve(8 * part.cells.size());
      for (unsigned int c = 0; c < part.cells.size(); ++c)
        {
          const MeshCells::Cell       &cell = part.cells[c];
          std::array<unsigned int, 10> vertices;
          std::copy(cell.vertices.begin(),
                    cell.vertices.end(),
                    vertices.begin());
          for (unsigned int e = 0; e < 6; ++e)
            vertices[4 + e] =
              middles.between(cell.vertices[ends_of_edges[e][0]],
                              cell.vertices[ends_of_edges[e][1]]);
          std::array<Point<3>, 10> places;
          if (cell.curve != MeshCells::straight)
            {
              const auto &corners = pieces[cell.curve].vertices;
              std::copy(corners.begin(), corners.end(), places.begin());
              for (unsigned int e = 0; e < 6; ++e)
                places[4 + e] = (corners[ends_of_edges[e][0]] +
                                 corners[ends_of_edges[e][1]]) /
                                2.;
            }
          diagonals.push_back(shortest_diagonal(part, vertices));
          for (unsigned int child = 0; child < 8; ++child)
            {
              MeshCells::Cell &new_cell = cells.emplace_back(cell);
              const auto      &own =
                tetrahedron_cuts()[diagonals.back()].vertices[child];
              for (unsigned int k = 0; k < 4; ++k)
                new_cell.vertices[k] = vertices[own[k]];
              numbers.push_back(8 * part.numbers[c] + child);
              if (cell.curve == MeshCells::straight)
                continue;
              new_cell.curve     = new_pieces.size();
              CurvedPiece &piece = new_pieces.emplace_back();
              piece.curve        = pieces[cell.curve].curve;
              for (unsigned int k = 0; k < 4; ++k)
                piece.vertices[k] = places[own[k]];
            }
        }
      middles.number(comm);
      refine_names(part, diagonals);
      part.cells   = std::move(cells);
      part.numbers = std::move(numbers);
      pieces       = std::move(new_pieces);
    }



    // Gives curved cells the nodes of their own maps, and moves each of their
    // vertices to its place on the first curved cell that has it. Returns which
    // vertices were moved.
    std::vector<bool>
    bend(MeshPart &part, const std::vector<CurvedPiece> &pieces)
    {
      const unsigned int          q      = part.geometry_degree;
      const std::vector<Point<3>> points = map_points(q);
      std::vector<Point<3>>       curved_nodes;
      std::vector<bool>           is_moved(part.vertices.size(), false);
      curved_nodes.reserve(points.size() * pieces.size());
      // The maps are reused, as many pieces have the same shape and place.
      std::map<std::array<double, 12>, MapAtPoints> maps;
      for (const MeshCells::Cell &cell : part.cells)
        {
          if (cell.curve == MeshCells::straight)
            continue;
          const auto &[curve, corners] = pieces[cell.curve];
          std::array<double, 12> key;
          for (unsigned int i = 0; i < 12; ++i)
            key[i] = corners[i / 3][i % 3];
          std::vector<Point<3>> places(points.size(), corners[0]);
          for (unsigned int i = 0; i < points.size(); ++i)
            for (unsigned int k = 0; k < 3; ++k)
              places[i] += points[i][k] * (corners[k + 1] - corners[0]);
          const MapAtPoints &map =
            maps.try_emplace(key, q, places).first->second;
          const Point<3> *nodes = &part.curved_nodes[points.size() * curve];
          for (unsigned int i = 0; i < points.size(); ++i)
            {
              curved_nodes.push_back(map.position(nodes, i));
              if (i < 4 && !is_moved[cell.vertices[i]])
                {
                  part.vertices[cell.vertices[i]] = curved_nodes.back();
                  is_moved[cell.vertices[i]]      = true;
                }
            }
        }
      part.curved_nodes = std::move(curved_nodes);
      return is_moved;
    }



    // A vertex that was moved on one rank is moved on all ranks to the same
    // place, that of the lowest rank that moved it.
    void
    agree_on_places(MeshPart                &part,
                    const std::vector<bool> &is_moved,
                    const MPI_Comm           comm)
    {
      const unsigned int n_ranks = MPI::n_mpi_processes(comm);
      if (n_ranks == 1)
        return;
      struct Placed
      {
        std::uint64_t         number;
        std::array<double, 3> place;
        unsigned int          vertex;
        bool                  is_moved;
      };
      std::map<unsigned int, std::vector<Placed>> told, agreed;
      for (unsigned int v = 0; v < part.vertices.size(); ++v)
        {
          const Point<3>     &x      = part.vertices[v];
          const std::uint64_t number = part.vertex_numbers[v];
          told[number % n_ranks].push_back(
            {number, {{x[0], x[1], x[2]}}, v, is_moved[v]});
        }
      auto lists = exchange_arrays(told, comm);
      std::map<std::uint64_t, std::array<double, 3>> places;
      for (const auto &[rank, list] : lists)
        for (const Placed &placed : list)
          if (placed.is_moved)
            places.emplace(placed.number, placed.place);
      for (const auto &[rank, list] : lists)
        for (Placed placed : list)
          if (const auto found = places.find(placed.number);
              found != places.end())
            {
              placed.place = found->second;
              agreed[rank].push_back(placed);
            }
      for (const auto &[rank, list] : exchange_arrays(agreed, comm))
        for (const Placed &placed : list)
          part.vertices[placed.vertex] =
            Point<3>(placed.place[0], placed.place[1], placed.place[2]);
    }



    // Makes the first nodes of curved cells equal to their vertices, to the
    // last digit.
    void
    set_vertices_of_curves(MeshPart &part)
    {
      for (const MeshCells::Cell &cell : part.cells)
        if (cell.curve != MeshCells::straight)
          for (unsigned int k = 0; k < 4; ++k)
            part
              .curved_nodes[std::size_t(part.n_map_nodes()) * cell.curve + k] =
              part.vertices[cell.vertices[k]];
    }
  } // namespace



  void
  refine_uniformly(MeshPart          &part,
                   const unsigned int n_refinements,
                   const MPI_Comm     comm)
  {
    std::vector<CurvedPiece> pieces(part.curved_nodes.size() /
                                    part.n_map_nodes());
    for (unsigned int i = 0; i < pieces.size(); ++i)
      {
        pieces[i].curve = i;
        for (unsigned int k = 1; k < 4; ++k)
          pieces[i].vertices[k][k - 1] = 1;
      }
    for (unsigned int i = 0; i < n_refinements; ++i)
      refine_once(part, pieces, comm);
    if (n_refinements == 0 || part.geometry_degree == 1)
      return;
    agree_on_places(part, bend(part, pieces), comm);
    set_vertices_of_curves(part);
    // All ranks keep the same degree.
    const unsigned int degree = part.geometry_degree;
    remove_straight_maps(part);
    part.geometry_degree =
      MPI::max(part.geometry_degree, comm) > 1 ? degree : 1;
  }

} // namespace corotet
