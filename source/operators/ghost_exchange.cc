// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/ghost_exchange.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numeric>

namespace corotet
{
  GhostExchange::GhostExchange(const MPI_Comm comm, const NodeNumbers &numbers)
    : comm(comm)
    , n_owned(numbers.n_owned())
    , n_ghosts(numbers.ghosts().size())
  {
    const int n_ranks = numbers.n_ranks();
    // The numbers of ghosts among the nodes of their owners.
    std::vector<int> nodes(n_ghosts);
    std::vector<int> n_got(n_ranks), n_sent(n_ranks);
    std::vector<int> ghost_begin(n_ranks), send_begin(n_ranks);
    for (int i = 0; i < n_ghosts; ++i)
      {
        const auto [owner, node] = numbers.owner(numbers.ghosts()[i]);
        nodes[i]                 = node;
        ++n_got[owner];
      }
    MPI_Alltoall(n_got.data(), 1, MPI_INT, n_sent.data(), 1, MPI_INT, comm);
    std::exclusive_scan(n_got.begin(), n_got.end(), ghost_begin.begin(), 0);
    std::exclusive_scan(n_sent.begin(), n_sent.end(), send_begin.begin(), 0);
    sent.resize(send_begin.back() + n_sent.back());
    MPI_Alltoallv(nodes.data(),
                  n_got.data(),
                  ghost_begin.data(),
                  MPI_INT,
                  sent.data(),
                  n_sent.data(),
                  send_begin.data(),
                  MPI_INT,
                  comm);
    for (int rank = 0; rank < n_ranks; ++rank)
      if (n_sent[rank] + n_got[rank] > 0)
        neighbours.push_back(
          {rank,
           {send_begin[rank], send_begin[rank] + n_sent[rank]},
           {ghost_begin[rank], ghost_begin[rank] + n_got[rank]}});
  }

  GhostExchange
  GhostExchange::append_rows(NodeGraph &graph) const
  {
    std::vector<int> lengths(n_items());
    for (int i = 0; i < n_owned; ++i)
      lengths[i] = graph.starts[i + 1] - graph.starts[i];
    update(lengths.data());
    for (int i = n_owned; i < n_items(); ++i)
      graph.starts.push_back(graph.starts.back() + lengths[i]);

    GhostExchange result;
    result.comm     = comm;
    result.n_owned  = graph.starts[n_owned];
    result.n_ghosts = graph.starts.back() - result.n_owned;
    for (const Neighbour &neighbour : neighbours)
      {
        const int send_begin = result.sent.size();
        for (int i = neighbour.sent.begin; i < neighbour.sent.end; ++i)
          for (int k = graph.starts[sent[i]]; k < graph.starts[sent[i] + 1];
               ++k)
            result.sent.push_back(k);
        result.neighbours.push_back(
          {neighbour.rank,
           {send_begin, static_cast<int>(result.sent.size())},
           {graph.starts[n_owned + neighbour.ghosts.begin] - result.n_owned,
            graph.starts[n_owned + neighbour.ghosts.end] - result.n_owned}});
      }
    graph.columns.resize(graph.starts.back());
    result.update(graph.columns.data());
    return result;
  }

  void
  GhostExchange::exchange(char *values, const std::size_t size) const
  {
    buffer.resize(std::max(buffer.size(), sent.size() * size));
    for (std::size_t i = 0; i < sent.size(); ++i)
      std::memcpy(&buffer[i * size], values + sent[i] * size, size);
    transfer(buffer.data(),
             &Neighbour::sent,
             values + n_owned * size,
             &Neighbour::ghosts,
             size);
  }

  void
  GhostExchange::return_ghosts(const char *values, const std::size_t size) const
  {
    buffer.resize(std::max(buffer.size(), sent.size() * size));
    transfer(values + n_owned * size,
             &Neighbour::ghosts,
             buffer.data(),
             &Neighbour::sent,
             size);
  }

  void
  GhostExchange::transfer(const char *source,
                          const Range Neighbour::*sent_range,
                          char                   *target,
                          const Range Neighbour::*received_range,
                          const std::size_t       size) const
  {
    constexpr int tag = 7316;
    requests.resize(2 * neighbours.size());
    MPI_Request *request = requests.data();
    // MPI counts bytes in int.
    constexpr std::size_t most  = std::numeric_limits<int>::max();
    const auto            start = [&](const auto  &call,
                           auto *const  data,
                           const Range &range,
                           const int    rank) {
      auto *const       begin   = data + range.begin * size;
      const std::size_t n_bytes = (range.end - range.begin) * size;
      if (n_bytes <= most)
        call(begin, n_bytes, MPI_BYTE, rank, tag, comm, request++);
      else
        call(begin,
             1,
             *dealii::Utilities::MPI::create_mpi_data_type_n_bytes(n_bytes),
             rank,
             tag,
             comm,
             request++);
    };
    for (const Neighbour &neighbour : neighbours)
      {
        start(MPI_Irecv, target, neighbour.*received_range, neighbour.rank);
        start(MPI_Isend, source, neighbour.*sent_range, neighbour.rank);
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }
} // namespace corotet
