// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_ghost_cells_h
#define corotet_mesh_ghost_cells_h

#include <corotet/mesh/local_mesh.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <type_traits>
#include <vector>

namespace corotet
{
  /**
   * The owned cells of a rank that are ghosts on other ranks, and its own
   * ghosts: the lists of what to send so that ghosts get the values of their
   * owners. Every rank finds its lists by itself, as it has all cells around
   * its own.
   */
  class GhostCells
  {
  public:
    explicit GhostCells(const LocalMesh &mesh);

    /// Copies values from owners to ghosts: @p values has @p n values for each
    /// local cell. Sends one message to each rank that owns ghosts. Collective.
    template <typename T>
    void
    update(std::vector<T> &values, const unsigned int n = 1) const
    {
      send<T>(
        n,
        [&](const unsigned int c, T *const sent) {
          std::copy_n(values.begin() + std::size_t(c) * n, n, sent);
        },
        [&](const unsigned int c, const T *const received) {
          std::copy_n(received, n, values.begin() + std::size_t(c) * n);
        });
    }

    /// Like update(), for values that are not stored by cells: calls get(c,
    /// sent) for an owned cell, to fill in @p n values, and put(c, received)
    /// for a ghost.
    template <typename T, typename Get, typename Put>
    void
    send(const unsigned int n, const Get &get, const Put &put) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      std::vector<std::vector<T>> sent, received;
      std::vector<MPI_Request>    requests;
      for (const Neighbor &neighbor : neighbors)
        {
          std::vector<T> &to = sent.emplace_back(neighbor.owned.size() * n);
          for (std::size_t i = 0; i < neighbor.owned.size(); ++i)
            get(neighbor.owned[i], to.data() + i * n);
          received.emplace_back(neighbor.ghosts.size() * n);
        }
      for (unsigned int i = 0; i < neighbors.size(); ++i)
        {
          const auto start =
            [&](auto *data, auto call, const std::size_t size) {
              const auto type =
                dealii::Utilities::MPI::create_mpi_data_type_n_bytes(size *
                                                                     sizeof(T));
              call(data,
                   1,
                   *type,
                   neighbors[i].rank,
                   0,
                   comm,
                   &requests.emplace_back());
            };
          start(received[i].data(), MPI_Irecv, received[i].size());
          start(sent[i].data(), MPI_Isend, sent[i].size());
        }
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
      for (unsigned int i = 0; i < neighbors.size(); ++i)
        for (std::size_t g = 0; g < neighbors[i].ghosts.size(); ++g)
          put(neighbors[i].ghosts[g], received[i].data() + g * n);
    }

  private:
    struct Neighbor
    {
      unsigned int rank;
      /// Numbers of local cells, ascending.
      std::vector<unsigned int> owned, ghosts;
    };

    MPI_Comm              comm;
    std::vector<Neighbor> neighbors;
  };
} // namespace corotet

#endif
