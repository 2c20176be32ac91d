// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/local_mesh.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "shared_vertices.h"

namespace corotet
{
  namespace
  {
    constexpr unsigned int none = LocalMesh::no_cell;

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
        find_cells_beside();
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
      // Of each rank, the cells of others that share a vertex with its own.
      void
      find_cells_beside()
      {
        for (unsigned int rank = 0; rank < cells_beside.size(); ++rank)
          owners.insert(owners.end(),
                        first_cell[rank + 1] - first_cell[rank],
                        rank);
        const SharedVertices shared(mesh.cells, owners, mesh.vertices.size());
        for (std::size_t c = 0; c < mesh.cells.size(); ++c)
          shared.for_each_rank_at(mesh.cells[c], [&](const unsigned int rank) {
            std::vector<std::size_t> &cells = cells_beside[rank];
            if (rank != owners[c] && (cells.empty() || cells.back() != c))
              cells.push_back(c);
          });
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
            part.owners.push_back(owners[c]);
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

      const SerialMesh &mesh;
      // Of each rank, and the number of cells.
      const std::vector<std::size_t> first_cell;
      // Of each cell.
      std::vector<dealii::types::subdomain_id> owners;
      std::vector<std::vector<std::size_t>>    cells_beside;
      const PartsOfCells                       names;
      // Of each vertex of the mesh, while a part is made.
      std::vector<unsigned int> local_number;
    };



    // Each face is put down at its lowest vertex by the first of its cells, and
    // taken away by the second: so the lists are short.
    void
    find_neighbors(LocalMesh &mesh)
    {
      struct OpenFace
      {
        unsigned int middle, highest;
        unsigned int cell, face;
        unsigned int next;
      };
      std::vector<unsigned int> first(mesh.vertices.size(), none);
      std::vector<OpenFace>     open;
      unsigned int              free = none;
      mesh.neighbors.assign(mesh.cells.size(), {{none, none, none, none}});
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          {
            std::array<unsigned int, 3> v;
            for (unsigned int i = 0; i < 3; ++i)
              v[i] = mesh.cells[c].vertices[corners_of_faces[f][i]];
            std::sort(v.begin(), v.end());
            unsigned int *link = &first[v[0]];
            while (*link != none &&
                   (open[*link].middle != v[1] || open[*link].highest != v[2]))
              link = &open[*link].next;
            if (*link != none)
              {
                const unsigned int found               = *link;
                OpenFace          &other               = open[found];
                mesh.neighbors[c][f]                   = other.cell;
                mesh.neighbors[other.cell][other.face] = c;
                *link                                  = other.next;
                other.next                             = free;
                free                                   = found;
                continue;
              }
            const OpenFace face{v[1], v[2], c, f, first[v[0]]};
            if (free == none)
              {
                first[v[0]] = open.size();
                open.push_back(face);
              }
            else
              {
                first[v[0]]       = free;
                free              = open[free].next;
                open[first[v[0]]] = face;
              }
          }
    }



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
    result.communicator    = comm;
    result.rank            = my_rank;
    result.n_global_cells  = MPI::broadcast(comm, mesh.cells.size(), 0);
    result.geometry_degree = MPI::broadcast(comm, mesh.geometry_degree, 0);
    find_neighbors(result);
    return result;
  }
} // namespace corotet
