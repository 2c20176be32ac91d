// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/cell_batches.h>
#include <corotet/discretization/nodes.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  namespace
  {
    // Limits of a chunk. What it reads and adds up, 64 bytes for each node in
    // double precision, may fill a second-level cache of 1 MiB: consecutive
    // cells need little of it at a time, and large chunks have few nodes in
    // common.
    constexpr unsigned int nodes_of_chunk = 1 << 14;
    constexpr unsigned int cells_of_chunk = 1 << 13;

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
  }

  CellNodes
  Nodes::cell_nodes(const unsigned int cell) const
  {
    if (nodes_of_cells.empty())
      return cell_batches->cell_nodes(cell);
    return {nodes_of_cells.data() +
              static_cast<std::size_t>(cell) * n_cell_nodes,
            n_cell_nodes};
  }

  CellBatches::CellBatches(const Nodes &nodes)
    : n_cell_nodes(nodes.n_nodes_per_cell())
    , n_local_nodes(nodes.n_local_nodes())
    , n_owned_cells(nodes.n_owned_cells())
    , n_local_cells(nodes.n_local_cells())
  {
    make_sections(nodes.first_cells_of_registers());
    // The cells with ghost nodes, rounded to whole registers.
    const auto [first, end] = nodes.cells_with_ghosts();
    const unsigned int first_ghosted =
      place(first).first / floats_per_batch * floats_per_batch;
    const unsigned int end_ghosted =
      end > 0 ?
        (place(end - 1).first / floats_per_batch + 1) * floats_per_batch :
        0;
    plan           = divide(nodes, 0, n_owned, {first_ghosted, end_ghosted});
    plan_of_ghosts = divide(nodes, n_owned, n_all, {});
    const auto n_chunks_before = [&](const unsigned int batch) {
      return static_cast<unsigned int>(
        std::count_if(plan.begin(), plan.end(), [&](const Chunk &chunk) {
          return chunk.first < batch;
        }));
    };
    ghosted_chunks = {n_chunks_before(first_ghosted),
                      n_chunks_before(end_ghosted)};
    find_final_nodes(nodes);
    number_nodes(nodes);
  }

  void
  CellBatches::make_sections(const std::vector<unsigned int> &first_cells)
  {
    std::vector<unsigned int> firsts(first_cells);
    firsts.insert(firsts.end(), {0, n_owned_cells});
    std::sort(firsts.begin(), firsts.end());
    firsts.erase(std::unique(firsts.begin(), firsts.end()), firsts.end());
    for (std::size_t s = 0; s < firsts.size(); ++s)
      {
        if (firsts[s] == n_owned_cells)
          n_owned = n_all;
        if (firsts[s] == n_local_cells)
          break;
        sections.push_back({firsts[s], n_all});
        const bool         is_last = s + 1 == firsts.size();
        const unsigned int n =
          (is_last ? n_local_cells : firsts[s + 1]) - firsts[s];
        n_all += is_last ? divide_up(n, batch_size) :
                           divide_up(n, batch_size * floats_per_batch) *
                             floats_per_batch;
      }
  }

  template <typename Function>
  void
  CellBatches::for_nodes(const Nodes       &nodes,
                         const unsigned int batch,
                         const Function    &function) const
  {
    const auto [first, end] = cells_from(batch);
    const std::size_t start =
      static_cast<std::size_t>(batch) * n_cell_nodes * batch_size;
    for (unsigned int lane = 0; lane < batch_size; ++lane)
      {
        const CellNodes cell =
          nodes.cell_nodes(std::min(first + lane, end - 1));
        for (unsigned int i = 0; i < n_cell_nodes; ++i)
          function(start + std::size_t(i) * batch_size + lane, cell[i]);
      }
  }

  std::vector<CellBatches::Chunk>
  CellBatches::divide(const Nodes                     &nodes,
                      const unsigned int               begin,
                      const unsigned int               end,
                      const std::vector<unsigned int> &cuts) const
  {
    std::vector<Chunk> result;
    // For each node, one more than the number of the last chunk that has it.
    std::vector<unsigned int> last_chunk(n_local_nodes, 0);
    unsigned int              n_nodes = 0;
    for (unsigned int batch = begin; batch < end; batch += floats_per_batch)
      {
        if (result.empty() || n_nodes >= nodes_of_chunk ||
            (batch - result.back().first) * batch_size >= cells_of_chunk ||
            std::find(cuts.begin(), cuts.end(), batch) != cuts.end())
          {
            result.push_back({batch, batch, 0, 0, 0, 0, 0, 0});
            n_nodes = 0;
          }
        Chunk &chunk = result.back();
        chunk.end    = std::min(batch + floats_per_batch, end);
        for (unsigned int b = batch; b < chunk.end; ++b)
          for_nodes(nodes, b, [&](const std::size_t, const unsigned int n) {
            if (last_chunk[n] != result.size())
              ++n_nodes;
            last_chunk[n] = result.size();
          });
      }
    return result;
  }

  void
  CellBatches::find_final_nodes(const Nodes &nodes)
  {
    std::vector<unsigned int> last_chunk(nodes.n_owned_nodes(), 0);
    for (unsigned int c = 0; c < plan.size(); ++c)
      for (unsigned int b = plan[c].first; b < plan[c].end; ++b)
        for_nodes(nodes, b, [&](const std::size_t, const unsigned int n) {
          if (n < last_chunk.size())
            last_chunk[n] = c;
        });
    unsigned int n_final = 0;
    for (unsigned int c = 0; c < plan.size(); ++c)
      {
        plan[c].first_node = n_final;
        while (n_final < nodes.first_shared_node() && last_chunk[n_final] <= c)
          ++n_final;
        plan[c].n_final = n_final;
      }
  }

  void
  CellBatches::number_nodes(const Nodes &nodes)
  {
    constexpr unsigned int none         = -1;
    const unsigned int     first_shared = nodes.first_shared_node();
    // The slot of each node, if it has one now, and the slots that are free
    // again.
    std::vector<unsigned int> slot(n_local_nodes, none);
    std::vector<unsigned int> free_slots;
    for (unsigned int n = first_shared; n < n_local_nodes; ++n)
      slot[n] = n - first_shared;
    slots = n_local_nodes - first_shared;
    // For each node, its number in the last chunk that has it, and one more
    // than the number of that chunk.
    std::vector<unsigned int> number(n_local_nodes), last_chunk(n_local_nodes);
    std::vector<unsigned int> others;
    node_numbers.resize(static_cast<std::size_t>(n_all) * n_cell_nodes *
                        batch_size);
    chunk_of_batch.resize(n_all);
    unsigned int chunk_number = 0;
    for (auto *const chunks : {&plan, &plan_of_ghosts})
      for (Chunk &chunk : *chunks)
        {
          others.clear();
          const auto is_final = [&](const unsigned int n) {
            return n >= chunk.first_node && n < chunk.n_final;
          };
          for (unsigned int b = chunk.first; b < chunk.end; ++b)
            for_nodes(nodes, b, [&](const std::size_t, const unsigned int n) {
              if (!is_final(n) && last_chunk[n] != chunk_number + 1)
                others.push_back(n);
              last_chunk[n] = chunk_number + 1;
            });
          std::sort(others.begin(), others.end());
          chunk.first_open = open.size();
          for (const unsigned int n : others)
            {
              number[n] =
                chunk.n_final_nodes() + open.size() - chunk.first_open;
              if (slot[n] == none && !free_slots.empty())
                {
                  slot[n] = free_slots.back();
                  free_slots.pop_back();
                }
              else if (slot[n] == none)
                slot[n] = slots++;
              open.push_back({n, slot[n]});
            }
          chunk.end_open        = open.size();
          chunk.first_continued = continued.size();
          for (unsigned int n = chunk.first_node; n < chunk.n_final; ++n)
            {
              number[n] = n - chunk.first_node;
              if (slot[n] != none)
                {
                  continued.push_back({number[n], slot[n]});
                  free_slots.push_back(slot[n]);
                }
            }
          chunk.end_continued = continued.size();
          const unsigned int n_nodes =
            chunk.n_final_nodes() + chunk.end_open - chunk.first_open;
          AssertThrow(n_nodes <= std::numeric_limits<std::uint16_t>::max(),
                      dealii::ExcInternalError());
          most_nodes = std::max(most_nodes, n_nodes);
          for (unsigned int b = chunk.first; b < chunk.end; ++b)
            {
              chunk_of_batch[b] = chunk_number;
              for_nodes(nodes,
                        b,
                        [&](const std::size_t k, const unsigned int n) {
                          node_numbers[k] = number[n];
                        });
            }
          ++chunk_number;
        }
    open.shrink_to_fit();
    continued.shrink_to_fit();
  }

  CellNodes
  CellBatches::cell_nodes(const unsigned int cell) const
  {
    const auto [batch, lane] = place(cell);
    const Chunk &chunk       = chunk_of(batch);
    return {nodes(batch) + lane,
            batch_size,
            n_cell_nodes,
            chunk.first_node,
            chunk.n_final_nodes(),
            open.data() + chunk.first_open};
  }

  std::pair<unsigned int, unsigned int>
  CellBatches::cells_from(const unsigned int batch) const
  {
    auto section = sections.end() - 1;
    while (section->first_batch > batch)
      --section;
    return {section->first_cell + (batch - section->first_batch) * batch_size,
            section + 1 == sections.end() ? n_local_cells :
                                            (section + 1)->first_cell};
  }

  std::pair<unsigned int, unsigned int>
  CellBatches::cells(const unsigned int batch) const
  {
    const auto [first, end] = cells_from(batch);
    // The last batches may only fill up a register and have no cells.
    return {first, first < end ? std::min(batch_size, end - first) : 0};
  }

  CellBatches
  CellBatches::apart() const
  {
    CellBatches result(*this);
    for (std::size_t k = 0; k < node_numbers.size(); ++k)
      {
        const unsigned int lane = k % batch_size;
        const unsigned int i    = k / batch_size % n_cell_nodes;
        result.node_numbers[k]  = lane * n_cell_nodes + i;
      }
    for (auto *const chunks : {&result.plan, &result.plan_of_ghosts})
      chunks->clear();
    return result;
  }
} // namespace corotet
