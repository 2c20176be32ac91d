// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/local_mesh.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace corotet
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    // Work of a curved cell, if that of a straight one is 1: the matrix-free
    // product takes about three times as long, that with the exact tangent as
    // long as on straight cells.
    constexpr std::size_t work_of_curved_cell = 2;



    // The first cell of each rank and, at the end, the number of cells. No rank
    // is without a cell.
    std::vector<std::size_t>
    pieces_of_equal_work(const SerialMesh &mesh, const std::size_t n_ranks)
    {
      const std::size_t        n_cells = mesh.cells.size();
      std::vector<std::size_t> work_before(n_cells + 1, 0);
      for (std::size_t c = 0; c < n_cells; ++c)
        work_before[c + 1] =
          work_before[c] + (mesh.cells[c].curve == SerialMesh::straight ?
                              1 :
                              work_of_curved_cell);

      std::vector<std::size_t> first(n_ranks + 1, 0);
      first.back() = n_cells;
      for (std::size_t r = 1; r < n_ranks; ++r)
        {
          const std::size_t c =
            std::lower_bound(work_before.begin(),
                             work_before.end(),
                             work_before.back() * r / n_ranks) -
            work_before.begin();
          first[r] = std::clamp(c, first[r - 1] + 1, n_cells - (n_ranks - r));
        }
      return first;
    }



    // Makes the parts of a mesh. It has the mesh on rank 0 only.
    class Parts
    {
    public:
      Parts(const SerialMesh &mesh, const unsigned int n_ranks)
        : mesh(mesh)
        , first_cell(pieces_of_equal_work(mesh, n_ranks))
        , cells_beside(n_ranks)
        , names(mesh)
        , local_number(mesh.vertices.size(), none)
      {
        find_cells_beside(n_ranks);
      }

      LocalMesh
      part(const unsigned int rank)
      {
        LocalMesh part;
        part.geometry_degree = mesh.geometry_degree;
        choose_cells(part, rank);
        add_names(part, rank);
        number_vertices(part);
        add_curved_nodes(part);
        return part;
      }

    private:
      unsigned int
      owner(const std::size_t cell) const
      {
        return std::upper_bound(first_cell.begin(), first_cell.end(), cell) -
               first_cell.begin() - 1;
      }

      // Of each rank, the cells of others that share a vertex with its own.
      void
      find_cells_beside(const unsigned int n_ranks)
      {
        // The rank of the first cell at each vertex, and further ones.
        std::vector<unsigned int> first_rank(mesh.vertices.size(), none);
        std::vector<std::pair<unsigned int, unsigned int>> ranks_of_vertices;
        for (unsigned int rank = 0; rank < n_ranks; ++rank)
          for (std::size_t c = first_cell[rank]; c < first_cell[rank + 1]; ++c)
            for (const unsigned int v : mesh.cells[c].vertices)
              if (first_rank[v] == none)
                first_rank[v] = rank;
              else if (first_rank[v] != rank)
                {
                  ranks_of_vertices.emplace_back(v, first_rank[v]);
                  ranks_of_vertices.emplace_back(v, rank);
                }
        std::sort(ranks_of_vertices.begin(), ranks_of_vertices.end());
        ranks_of_vertices.erase(std::unique(ranks_of_vertices.begin(),
                                            ranks_of_vertices.end()),
                                ranks_of_vertices.end());
        std::vector<bool> is_shared(mesh.vertices.size(), false);
        for (const auto &[v, rank] : ranks_of_vertices)
          is_shared[v] = true;

        for (unsigned int rank = 0; rank < n_ranks; ++rank)
          for (std::size_t c = first_cell[rank]; c < first_cell[rank + 1]; ++c)
            for (const unsigned int v : mesh.cells[c].vertices)
              if (is_shared[v])
                for (auto other = std::lower_bound(ranks_of_vertices.begin(),
                                                   ranks_of_vertices.end(),
                                                   std::pair(v, 0u));
                     other != ranks_of_vertices.end() && other->first == v;
                     ++other)
                  {
                    std::vector<std::size_t> &cells =
                      cells_beside[other->second];
                    if (other->second != rank &&
                        (cells.empty() || cells.back() != c))
                      cells.push_back(c);
                  }
      }

      void
      choose_cells(LocalMesh &part, const unsigned int rank) const
      {
        const std::vector<std::size_t> &beside = cells_beside[rank];
        const auto                      behind =
          std::lower_bound(beside.begin(), beside.end(), first_cell[rank]);
        part.numbers.assign(beside.begin(), behind);
        for (std::size_t c = first_cell[rank]; c < first_cell[rank + 1]; ++c)
          part.numbers.push_back(c);
        part.numbers.insert(part.numbers.end(), behind, beside.end());

        part.cells.reserve(part.numbers.size());
        part.owners.reserve(part.numbers.size());
        for (const auto c : part.numbers)
          {
            part.cells.push_back(mesh.cells[c]);
            part.owners.push_back(owner(c));
          }
      }

      // While vertices have the numbers that the names know.
      void
      add_names(LocalMesh &part, const unsigned int rank) const
      {
        for (unsigned int c = 0; c < part.cells.size(); ++c)
          {
            names.add_faces(part.faces, part.cells[c], c);
            if (part.owners[c] != rank)
              continue;
            names.add_edges(part.edges, part.cells[c], c);
            names.add_corners(part.corners, part.cells[c], c);
          }
      }

      void
      number_vertices(LocalMesh &part)
      {
        std::vector<unsigned int> used;
        for (const SerialMesh::Cell &cell : part.cells)
          for (const unsigned int v : cell.vertices)
            if (std::exchange(local_number[v], 0) == none)
              used.push_back(v);
        std::sort(used.begin(), used.end());
        part.vertices.reserve(used.size());
        for (unsigned int i = 0; i < used.size(); ++i)
          {
            local_number[used[i]] = i;
            part.vertices.push_back(mesh.vertices[used[i]]);
          }
        for (SerialMesh::Cell &cell : part.cells)
          for (unsigned int &v : cell.vertices)
            v = local_number[v];
        for (const unsigned int v : used)
          local_number[v] = none;
      }

      void
      add_curved_nodes(LocalMesh &part) const
      {
        const std::size_t q        = mesh.geometry_degree;
        const std::size_t n_nodes  = (q + 1) * (q + 2) * (q + 3) / 6;
        unsigned int      n_curves = 0;
        for (SerialMesh::Cell &cell : part.cells)
          if (cell.curve != SerialMesh::straight)
            {
              const dealii::Point<3> *nodes = curved_nodes(mesh, cell);
              part.curved_nodes.insert(part.curved_nodes.end(),
                                       nodes,
                                       nodes + n_nodes);
              cell.curve = n_curves++;
            }
      }

      const SerialMesh                     &mesh;
      const std::vector<std::size_t>        first_cell;
      std::vector<std::vector<std::size_t>> cells_beside;
      const PartsOfCells                    names;
      // Of each vertex of the mesh, while a part is made.
      std::vector<unsigned int> local_number;
    };



    // What a message consists of, in its order.
    template <typename Action>
    void
    for_each_array(LocalMesh &part, const Action &action)
    {
      action(part.vertices);
      action(part.cells);
      action(part.numbers);
      action(part.owners);
      action(part.faces);
      action(part.edges);
      action(part.corners);
      action(part.curved_nodes);
    }
  } // namespace



  LocalMesh
  distribute(const SerialMesh &mesh, const MPI_Comm comm)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int my_rank = MPI::this_mpi_process(comm);
    const unsigned int n_ranks = MPI::n_mpi_processes(comm);

    std::unique_ptr<Parts> parts;
    on_root(comm, [&] { parts = std::make_unique<Parts>(mesh, n_ranks); });

    LocalMesh result;
    for (unsigned int rank = 1; rank <= n_ranks; ++rank)
      {
        // That of rank 0 is the last.
        const unsigned int receiver = rank % n_ranks;
        LocalMesh          part;
        on_root(comm, [&] { part = parts->part(receiver); });
        if (receiver != 0 && my_rank == 0)
          for_each_array(part, [&](const auto &array) {
            send_array(array, receiver, comm);
          });
        else if (receiver != 0 && my_rank == receiver)
          for_each_array(part,
                         [&](auto &array) { receive_array(array, 0, comm); });
        if (my_rank == receiver)
          result = std::move(part);
      }
    result.geometry_degree = MPI::broadcast(comm, mesh.geometry_degree, 0);
    return result;
  }
} // namespace corotet
