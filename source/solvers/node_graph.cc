// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/node_graph.h>

#include <deal.II/base/exceptions.h>

#include <Epetra_BlockMap.h>
#include <Epetra_MpiComm.h>

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace corotet
{
  NodeRows::NodeRows(const Epetra_CrsGraph &graph)
  {
    const int n_own = graph.NumMyRows();
    for (int column = n_own; column < graph.NumMyCols(); ++column)
      ghost_nodes.push_back(graph.GCID(column) / 3);
    std::sort(ghost_nodes.begin(), ghost_nodes.end());
    ghost_nodes.erase(std::unique(ghost_nodes.begin(), ghost_nodes.end()),
                      ghost_nodes.end());
    // Our number of a column.
    std::vector<int> numbers(graph.NumMyCols());
    for (int column = 0; column < graph.NumMyCols(); ++column)
      if (column < n_own)
        numbers[column] = column;
      else
        {
          const int  id = graph.GCID(column);
          const auto place =
            std::lower_bound(ghost_nodes.begin(), ghost_nodes.end(), id / 3);
          numbers[column] = n_own + 3 * (place - ghost_nodes.begin()) + id % 3;
        }

    std::vector<int> order;
    for (int row = 0; row < n_own; row += 3)
      {
        int  length;
        int *columns;
        graph.ExtractMyRowView(row, length, columns);
        order.resize(length);
        std::iota(order.begin(), order.end(), 0);
        const bool has_ghosts = length > 0 && columns[length - 1] >= n_own;
        if (has_ghosts)
          {
            std::sort(order.begin(), order.end(), [&](int k, int l) {
              return numbers[columns[k]] < numbers[columns[l]];
            });
            ghost_places.columns.insert(ghost_places.columns.end(),
                                        order.begin(),
                                        order.end());
          }
        ghost_places.starts.push_back(ghost_places.columns.size());
        for (int k = 0; k < length; k += 3)
          {
            const int first = numbers[columns[order[k]]];
            AssertThrow(first % 3 == 0 && k + 2 < length &&
                          numbers[columns[order[k + 2]]] == first + 2,
                        dealii::ExcMessage("The matrix has no full blocks."));
            nodes.columns.push_back(first / 3);
          }
        nodes.starts.push_back(nodes.columns.size());
      }
  }

  std::array<const double *, 3>
  NodeRows::rows(const Epetra_CrsMatrix &A, const int node) const
  {
    const int begin = ghost_places.starts[node];
    const int end   = ghost_places.starts[node + 1];
    buffer.resize(3 * (end - begin));
    std::array<const double *, 3> result;
    for (int a = 0; a < 3; ++a)
      {
        int     length;
        double *values;
        A.ExtractMyRowView(3 * node + a, length, values);
        result[a] = values;
        if (begin == end)
          continue;
        double *target = &buffer[a * (end - begin)];
        result[a]      = target;
        for (int k = begin; k < end; ++k)
          *target++ = values[ghost_places.columns[k]];
      }
    return result;
  }

  GhostExchange::GhostExchange(const Epetra_CrsGraph  &graph,
                               const std::vector<int> &ghosts)
    : comm(dynamic_cast<const Epetra_MpiComm &>(graph.Comm()).Comm())
    , n_owned(graph.NumMyRows() / 3)
    , n_ghosts(ghosts.size())
  {
    std::vector<int> unknowns(n_ghosts), owners(n_ghosts), nodes(n_ghosts);
    for (int i = 0; i < n_ghosts; ++i)
      unknowns[i] = 3 * ghosts[i];
    graph.RowMap().RemoteIDList(n_ghosts,
                                unknowns.data(),
                                owners.data(),
                                nodes.data());
    for (int &node : nodes)
      node /= 3;

    const int        n_ranks = graph.Comm().NumProc();
    std::vector<int> n_got(n_ranks), n_sent(n_ranks);
    std::vector<int> ghost_begin(n_ranks), send_begin(n_ranks);
    for (const int owner : owners)
      ++n_got[owner];
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
        neighbours.push_back({rank,
                              send_begin[rank],
                              send_begin[rank] + n_sent[rank],
                              ghost_begin[rank],
                              ghost_begin[rank] + n_got[rank]});
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
        for (int i = neighbour.send_begin; i < neighbour.send_end; ++i)
          for (int k = graph.starts[sent[i]]; k < graph.starts[sent[i] + 1];
               ++k)
            result.sent.push_back(k);
        result.neighbours.push_back(
          {neighbour.rank,
           send_begin,
           static_cast<int>(result.sent.size()),
           graph.starts[n_owned + neighbour.ghost_begin] - result.n_owned,
           graph.starts[n_owned + neighbour.ghost_end] - result.n_owned});
      }
    graph.columns.resize(graph.starts.back());
    result.update(graph.columns.data());
    return result;
  }

  void
  GhostExchange::exchange(char *values, const std::size_t size) const
  {
    constexpr int tag = 7316;
    buffer.resize(std::max(buffer.size(), sent.size() * size));
    requests.resize(2 * neighbours.size());
    MPI_Request *request = requests.data();
    for (const Neighbour &neighbour : neighbours)
      {
        MPI_Irecv(values + (n_owned + neighbour.ghost_begin) * size,
                  (neighbour.ghost_end - neighbour.ghost_begin) * size,
                  MPI_BYTE,
                  neighbour.rank,
                  tag,
                  comm,
                  request++);
        for (int i = neighbour.send_begin; i < neighbour.send_end; ++i)
          std::memcpy(&buffer[i * size], values + sent[i] * size, size);
        MPI_Isend(buffer.data() + neighbour.send_begin * size,
                  (neighbour.send_end - neighbour.send_begin) * size,
                  MPI_BYTE,
                  neighbour.rank,
                  tag,
                  comm,
                  request++);
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
  }

  NodeGraph
  transpose(const NodeGraph &graph, const int n_columns)
  {
    NodeGraph result;
    result.starts.assign(n_columns + 1, 0);
    for (const int column : graph.columns)
      ++result.starts[column + 1];
    for (int i = 0; i < n_columns; ++i)
      result.starts[i + 1] += result.starts[i];
    result.columns.resize(graph.columns.size());
    std::vector<int> next(result.starts);
    for (int row = 0; row < graph.n_rows(); ++row)
      for (int k = graph.starts[row]; k < graph.starts[row + 1]; ++k)
        result.columns[next[graph.columns[k]]++] = row;
    return result;
  }

  NodeGraph
  product(const NodeGraph &a, const NodeGraph &b, const int n_columns)
  {
    NodeGraph        result;
    std::vector<int> last_seen(n_columns, -1);
    for (int row = 0; row < a.n_rows(); ++row)
      {
        for (int k = a.starts[row]; k < a.starts[row + 1]; ++k)
          for (int l = b.starts[a.columns[k]]; l < b.starts[a.columns[k] + 1];
               ++l)
            if (std::exchange(last_seen[b.columns[l]], row) != row)
              result.columns.push_back(b.columns[l]);
        std::sort(result.columns.begin() + result.starts.back(),
                  result.columns.end());
        result.starts.push_back(result.columns.size());
      }
    return result;
  }

  std::vector<int>
  aggregate(const NodeGraph &graph, const std::function<bool(int)> &is_strong)
  {
    const int        n = graph.n_rows();
    std::vector<int> aggregates(n, -1);
    int              n_aggregates = 0;
    NodeGraph        strong;
    for (int node = 0; node < n; ++node)
      {
        for (int k = graph.starts[node]; k < graph.starts[node + 1]; ++k)
          if (graph.columns[k] == node || is_strong(k))
            strong.columns.push_back(graph.columns[k]);
        strong.starts.push_back(strong.columns.size());
      }
    const auto neighbours = [&](const int node) {
      return std::make_pair(strong.columns.begin() + strong.starts[node],
                            strong.columns.begin() + strong.starts[node + 1]);
    };
    const auto is_free = [&](const int node) { return aggregates[node] < 0; };
    for (int node = 0; node < n; ++node)
      {
        const auto [begin, end] = neighbours(node);
        if (end - begin > 1 && std::all_of(begin, end, is_free))
          {
            std::for_each(begin, end, [&](const int other) {
              aggregates[other] = n_aggregates;
            });
            ++n_aggregates;
          }
      }

    const std::vector<int> first(aggregates);
    std::vector<int>       votes(n_aggregates, 0);
    for (int node = 0; node < n; ++node)
      if (first[node] < 0)
        {
          const auto [begin, end] = neighbours(node);
          int best                = -1;
          for (auto other = begin; other != end; ++other)
            if (const int candidate = first[*other]; candidate >= 0)
              if (++votes[candidate] > (best < 0 ? 0 : votes[best]))
                best = candidate;
          for (auto other = begin; other != end; ++other)
            if (first[*other] >= 0)
              votes[first[*other]] = 0;
          aggregates[node] = best < 0 ? n_aggregates++ : best;
        }
    return aggregates;
  }
} // namespace corotet
