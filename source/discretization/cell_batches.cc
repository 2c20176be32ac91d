// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/cell_batches.h>
#include <corotet/discretization/nodes.h>

#include <algorithm>
#include <bit>

namespace corotet
{
  namespace
  {
    // Small enough for what a chunk touches to stay in the second-level cache,
    // large enough for its overhead not to matter.
    constexpr unsigned int batches_per_chunk = 8 * floats_per_batch;

    constexpr unsigned int
    divide_up(const unsigned int n, const unsigned int size)
    {
      return (n + size - 1) / size;
    }
  } // namespace

  Nodes::Nodes(const Element element)
    : cell_element(element)
    , n_cell_nodes(element.n_nodes())
  {}

  Nodes::~Nodes() = default;

  void
  Nodes::make_batches()
  {
    cell_batches = std::make_unique<CellBatches>(*this);
    std::vector<unsigned int>().swap(nodes_of_cells);
    static_assert(std::has_single_bit(batch_size));
    nodes_of_batches = cell_batches->nodes(0);
    n_filled_up      = cell_batches->n_owned_batches() * batch_size - n_owned;
    log_width        = std::countr_zero(batch_size);
  }

  CellBatches::CellBatches(const Nodes &nodes)
    : n_cell_nodes(nodes.n_nodes_per_cell())
    , n_local_nodes(nodes.n_local_nodes())
    , n_owned_cells(nodes.n_owned_cells())
    , n_local_cells(nodes.n_local_cells())
    , n_owned(divide_up(n_owned_cells, batch_size * floats_per_batch) *
              floats_per_batch)
    , at_end(n_owned + divide_up(n_local_cells - n_owned_cells, batch_size))
  {
    const std::size_t n = static_cast<std::size_t>(n_cell_nodes) * batch_size;
    node_numbers.resize(at_end.size() * n);
    for (unsigned int b = 0; b < at_end.size(); ++b)
      {
        const bool         is_owned = b < n_owned;
        const unsigned int first    = is_owned ?
                                        b * batch_size :
                                        n_owned_cells + (b - n_owned) * batch_size;
        const unsigned int last =
          (is_owned ? n_owned_cells : nodes.n_local_cells()) - 1;
        unsigned int *const numbers = node_numbers.data() + b * n;
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            numbers[i * batch_size + lane] =
              nodes.cell_nodes(std::min(first + lane, last))[i];
        if (std::find(numbers, numbers + n, nodes.n_local_nodes() - 1) !=
            numbers + n)
          at_end[b] = 1;
      }
    plan_chunks(nodes);
    if (exceed_caches<double>())
      plan_fetches(nodes);
  }

  std::pair<unsigned int, unsigned int>
  CellBatches::cells(const unsigned int batch) const
  {
    const bool         is_owned = batch < n_owned;
    const unsigned int end      = is_owned ? n_owned_cells : n_local_cells;
    const unsigned int first    = is_owned ?
                                    batch * batch_size :
                                    n_owned_cells + (batch - n_owned) * batch_size;
    // Owned batches may be there to make a multiple.
    return {first, first < end ? std::min(batch_size, end - first) : 0};
  }

  CellBatches
  CellBatches::apart() const
  {
    CellBatches result(*this);
    // One more, so that four numbers can be read everywhere.
    result.n_local_nodes = batch_size * n_cell_nodes + 1;
    result.at_end.assign(at_end.size(), 0);
    result.fetched_nodes.clear();
    result.fetch_starts.clear();
    unsigned int *next = result.node_numbers.data();
    for (unsigned int batch = 0; batch < n_batches(); ++batch)
      for (unsigned int i = 0; i < n_cell_nodes; ++i)
        for (unsigned int lane = 0; lane < batch_size; ++lane)
          *next++ = lane * n_cell_nodes + i;
    return result;
  }

  void
  CellBatches::plan_chunks(const Nodes &nodes)
  {
    std::vector<unsigned int> last_chunk(nodes.n_owned_nodes(), 0);
    for (unsigned int first = 0; first < n_owned; first += batches_per_chunk)
      {
        const unsigned int end = std::min(first + batches_per_chunk, n_owned);
        for (const unsigned int *n = this->nodes(first); n < this->nodes(end);
             ++n)
          if (*n < nodes.n_owned_nodes())
            last_chunk[*n] = plan.size();
        plan.push_back({first, end, 0});
      }
    unsigned int n_final = 0;
    for (unsigned int c = 0; c < plan.size(); ++c)
      {
        while (n_final < nodes.first_shared_node() && last_chunk[n_final] <= c)
          ++n_final;
        plan[c].n_final = n_final;
      }
    constexpr unsigned int size = batches_per_chunk * batch_size;
    ghosted_chunks              = {nodes.cells_with_ghosts().first / size,
                                   divide_up(nodes.cells_with_ghosts().second, size)};
  }

  void
  CellBatches::plan_fetches(const Nodes &nodes)
  {
    // One more than the batch that had a node last.
    std::vector<unsigned int> last_use(nodes.n_local_nodes(), 0);
    fetch_starts.reserve(n_batches() + 1 + 2 * floats_per_batch);
    fetch_starts.push_back(0);
    for (unsigned int b = 0; b < n_batches(); ++b)
      {
        for (const unsigned int *n = this->nodes(b); n < this->nodes(b + 1);
             ++n)
          {
            unsigned int &last = last_use[*n];
            if (last == 0 || last + batches_per_chunk <= b)
              fetched_nodes.push_back(*n);
            last = b + 1;
          }
        fetch_starts.push_back(fetched_nodes.size());
      }
    fetch_starts.resize(n_batches() + 1 + 2 * floats_per_batch,
                        fetched_nodes.size());
    fetched_nodes.shrink_to_fit();
  }
} // namespace corotet
