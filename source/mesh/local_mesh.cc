// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/base/mpi.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/check_surface.h>
#include <corotet/mesh/face_neighbors.h>
#include <corotet/mesh/mesh_part.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>
#include <utility>

namespace corotet
{
  namespace
  {
    namespace MPI = dealii::Utilities::MPI;

    // A vertex of a part, and another rank that has cells with this vertex.
    struct SharedVertex
    {
      unsigned int vertex;
      unsigned int rank;
    };



    // The first place of each vertex in the part's own cells: four times the
    // number of the cell, plus the corner.
    std::vector<std::uint64_t>
    first_places(const MeshPart &part)
    {
      constexpr std::uint64_t none = std::numeric_limits<std::uint64_t>::max();
      std::vector<std::uint64_t> places(part.vertices.size(), none);
      for (unsigned int c = 0; c < part.cells.size(); ++c)
        for (unsigned int k = 0; k < 4; ++k)
          {
            std::uint64_t &place = places[part.cells[c].vertices[k]];
            if (place == none)
              place = 4 * part.numbers[c] + k;
          }
      return places;
    }



    // A vertex in a message. Ranks send their vertices to the rank that keeps a
    // list of them (number modulo the number of ranks), and receive from there
    // the other ranks that have the same vertex.
    struct ListedVertex
    {
      std::uint64_t number;
      // The first place on the sending rank, or in the answer on all ranks.
      std::uint64_t place;
      // The index in the part of the rank that sends it, or gets the answer.
      unsigned int vertex;
      // The rank that sends it, or in the answer the other rank.
      unsigned int rank;
    };



    // The answers of the keeper of a list to the ranks that have sent vertices.
    std::map<unsigned int, std::vector<ListedVertex>>
    answers(const std::map<unsigned int, std::vector<ListedVertex>> &told)
    {
      std::vector<ListedVertex> list;
      for (const auto &[rank, vertices] : told)
        list.insert(list.end(), vertices.begin(), vertices.end());
      std::sort(list.begin(),
                list.end(),
                [](const ListedVertex &a, const ListedVertex &b) {
                  return std::pair(a.number, a.rank) <
                         std::pair(b.number, b.rank);
                });
      std::map<unsigned int, std::vector<ListedVertex>> result;
      for (std::size_t i = 0, end = 0; i < list.size(); i = end)
        {
          std::uint64_t first = list[i].place;
          for (end = i; end < list.size() && list[end].number == list[i].number;
               ++end)
            first = std::min(first, list[end].place);
          for (std::size_t a = i; a < end; ++a)
            for (std::size_t b = i; b < end; ++b)
              if (a != b)
                result[list[a].rank].push_back(
                  {list[a].number, first, list[a].vertex, list[b].rank});
        }
      return result;
    }



    // Numbers the vertices as LocalMesh says, and returns those that other
    // ranks also have, sorted by ranks. @p neighbors are those among the part's
    // own cells.
    std::vector<SharedVertex>
    number_vertices(MeshPart            &part,
                    const CellNeighbors &neighbors,
                    const MPI_Comm       comm)
    {
      // Cells of other ranks can only be behind faces without a neighbor.
      std::vector<bool> is_open(part.vertices.size(), false);
      for (unsigned int c = 0; c < part.cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          if (neighbors[c][f] == LocalMesh::no_cell)
            for (const unsigned int k : corners_of_faces[f])
              is_open[part.cells[c].vertices[k]] = true;

      std::vector<std::uint64_t> places  = first_places(part);
      const unsigned int         n_ranks = MPI::n_mpi_processes(comm);
      const unsigned int         my_rank = MPI::this_mpi_process(comm);
      std::map<unsigned int, std::vector<ListedVertex>> told;
      for (unsigned int v = 0; v < places.size(); ++v)
        if (is_open[v])
          {
            const std::uint64_t number = part.vertex_numbers[v];
            told[number % n_ranks].push_back({number, places[v], v, my_rank});
          }
      std::vector<SharedVertex> shared;
      for (const auto &[keeper, vertices] :
           exchange_arrays(answers(exchange_arrays(told, comm)), comm))
        for (const ListedVertex &listed : vertices)
          {
            places[listed.vertex] = listed.place;
            shared.push_back({listed.vertex, listed.rank});
          }
      std::sort(shared.begin(),
                shared.end(),
                [](const SharedVertex &a, const SharedVertex &b) {
                  return std::pair(a.rank, a.vertex) <
                         std::pair(b.rank, b.vertex);
                });
      part.vertex_numbers = std::move(places);
      return shared;
    }



    // The messages for other ranks: the cells that share a vertex with theirs.
    Messages
    cells_for_others(const MeshPart                  &part,
                     const std::vector<SharedVertex> &shared)
    {
      Messages                   messages;
      PartCutter                 cutter(part);
      std::vector<unsigned char> is_at_rank(part.vertices.size(), 0);
      for (const SharedVertex &s : shared)
        is_at_rank[s.vertex] = 1;
      const auto has_one = [&](const unsigned int c) {
        const auto &v = part.cells[c].vertices;
        return (is_at_rank[v[0]] | is_at_rank[v[1]] | is_at_rank[v[2]] |
                is_at_rank[v[3]]) != 0;
      };
      std::vector<unsigned int> outer_cells, cells;
      for (unsigned int c = 0; c < part.cells.size(); ++c)
        if (has_one(c))
          outer_cells.push_back(c);
      is_at_rank.assign(part.vertices.size(), 0);
      for (auto begin = shared.begin(), end = begin; begin != shared.end();
           begin = end)
        {
          for (end = begin; end != shared.end() && end->rank == begin->rank;
               ++end)
            is_at_rank[end->vertex] = 1;
          cells.clear();
          std::copy_if(outer_cells.begin(),
                       outer_cells.end(),
                       std::back_inserter(cells),
                       has_one);
          MeshPart beside = cutter.cut(cells);
          // Only owned cells have named edges and corners.
          beside.edges.clear();
          beside.corners.clear();
          messages[begin->rank] = packed(beside);
          for (auto s = begin; s != end; ++s)
            is_at_rank[s->vertex] = 0;
        }
      return messages;
    }



    // Makes a mesh of the cells of this rank and those of other ranks beside
    // them; the neighbors among its own cells are set.
    void
    add_cells_beside(LocalMesh &mesh, MeshPart &&part)
    {
      const CellNeighbors among_own =
        undisputed_neighbors(part, LocalMesh::no_cell);
      const std::vector<SharedVertex> shared =
        number_vertices(part, among_own, mesh.communicator);
      Messages received =
        exchange_messages(cells_for_others(part, shared), mesh.communicator);
      const unsigned int               degree = part.geometry_degree;
      std::map<unsigned int, MeshPart> of_ranks;
      for (auto &[rank, message] : received)
        {
          std::size_t position = 0;
          of_ranks[rank]       = unpacked(message, position);
          message              = {};
        }
      of_ranks[mesh.rank] = std::move(part);
      std::vector<MeshPart>                              parts;
      std::vector<unsigned int>                          owners;
      std::vector<std::pair<unsigned int, unsigned int>> order;
      for (auto &[rank, of_rank] : of_ranks)
        {
          parts.push_back(std::move(of_rank));
          owners.push_back(rank);
          for (unsigned int c = 0; c < parts.back().cells.size(); ++c)
            order.emplace_back(parts.size() - 1, c);
        }
      const auto number = [&](const auto &place) {
        return parts[place.first].numbers[place.second];
      };
      const auto is_before = [&](const auto &a, const auto &b) {
        return number(a) < number(b);
      };
      // Pieces of the curve are sorted already.
      if (!std::is_sorted(order.begin(), order.end(), is_before))
        std::sort(order.begin(), order.end(), is_before);

      std::vector<unsigned int> own_cells(among_own.size());
      mesh.owners.reserve(order.size());
      for (const auto &[p, c] : order)
        {
          if (owners[p] == mesh.rank)
            own_cells[c] = mesh.owners.size();
          mesh.owners.push_back(owners[p]);
        }
      constexpr unsigned int none = LocalMesh::no_cell;
      mesh.neighbors.assign(order.size(), {{none, none, none, none}});
      for (unsigned int c = 0; c < own_cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          if (among_own[c][f] != none)
            mesh.neighbors[own_cells[c]][f] = own_cells[among_own[c][f]];

      static_cast<MeshPart &>(mesh) = merged(parts, order);
      mesh.geometry_degree          = degree;
      sort_vertices(mesh);
    }
  } // namespace



  LocalMesh
  with_cells_beside(MeshPart         &&part,
                    const std::string &origin,
                    const MPI_Comm     comm)
  {
    LocalMesh mesh;
    mesh.communicator   = comm;
    mesh.rank           = MPI::this_mpi_process(comm);
    mesh.n_global_cells = MPI::sum(std::uint64_t(part.cells.size()), comm);
    if (MPI::n_mpi_processes(comm) == 1)
      {
        part.vertex_numbers = first_places(part);
        mesh.owners.assign(part.cells.size(), 0);
        static_cast<MeshPart &>(mesh) = std::move(part);
      }
    else
      add_cells_beside(mesh, std::move(part));

    on_all_ranks(comm, [&] {
      mesh.neighbors = find_neighbors(
        mesh,
        LocalMesh::no_cell,
        origin,
        [&](const unsigned int c) { return mesh.is_owned(c); },
        std::move(mesh.neighbors));
    });
    return mesh;
  }



  void
  check_surface_on_ranks(const LocalMesh &mesh, const std::string &origin)
  {
    CellSurface surface;
    on_all_ranks(mesh.communicator, [&] {
      surface = cell_surface(
        mesh,
        mesh.neighbors,
        LocalMesh::no_cell,
        [&](const unsigned int c) { return mesh.is_owned(c); },
        [&](const unsigned int v) { return mesh.vertex_numbers[v]; });
    });
    add_triangles_nearby(surface, mesh.communicator);
    on_all_ranks(mesh.communicator, [&] { check_surface(surface, origin); });
  }



  MeshPart
  owned_part(const LocalMesh &mesh)
  {
    std::vector<unsigned int> cells;
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      if (mesh.is_owned(c))
        cells.push_back(c);
    return PartCutter(mesh).cut(cells);
  }



  LocalMesh
  distribute(SerialMesh mesh, const MPI_Comm comm)
  {
    NamedParts names = named_parts(mesh);
    MeshPart   part  = scatter(whole_part(mesh, std::move(names)), comm);
    sort_along_curve(part, comm);
    return with_cells_beside(std::move(part), mesh.origin, comm);
  }
} // namespace corotet
