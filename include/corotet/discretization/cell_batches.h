// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_cell_batches_h
#define corotet_discretization_cell_batches_h

#include <corotet/base/simd.h>

#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace corotet
{
  class CurvedBatches;
  class Nodes;

  /// Registers of this many cells are what batches are counted in; a register
  /// of floats holds floats_per_batch batches.
  inline constexpr unsigned int batch_size       = n_lanes<double>;
  inline constexpr unsigned int floats_per_batch = n_lanes<float> / batch_size;

  /**
   * The local cells in batches of batch_size, and the plan of a sweep over the
   * owned ones. Batches at the end are filled up: lanes without a cell have
   * nodes of another one and must contribute zeros.
   */
  class CellBatches
  {
  public:
    /// Batches [first, end): after them the owned nodes below n_final get no
    /// contributions of owned cells any more.
    struct Chunk
    {
      unsigned int first;
      unsigned int end;
      unsigned int n_final;
    };

    explicit CellBatches(const Nodes &nodes);

    /// Batches of owned cells, a multiple of floats_per_batch; those of ghost
    /// cells follow.
    unsigned int
    n_owned_batches() const
    {
      return n_owned;
    }

    /// Batches of owned and ghost cells.
    unsigned int
    n_batches() const
    {
      return at_end.size();
    }

    /// What there is to know about batches with curved cells; null if no cell
    /// of the rank is curved.
    const CurvedBatches *
    curved() const
    {
      return curved_batches.get();
    }

    void
    set_curved(const std::shared_ptr<const CurvedBatches> &curved)
    {
      curved_batches = curved;
    }

    /// Batch and lane of a local cell.
    std::pair<unsigned int, unsigned int>
    place(const unsigned int cell) const
    {
      const bool         is_owned = cell < n_owned_cells;
      const unsigned int i        = is_owned ? cell : cell - n_owned_cells;
      return {(is_owned ? 0 : n_owned) + i / batch_size, i % batch_size};
    }

    /// First local cell of a batch, and how many cells it has.
    std::pair<unsigned int, unsigned int>
    cells(const unsigned int batch) const;

    /// The same batches as if no cells shared nodes: in each batch, node i of
    /// the cell in lane l has the number l * nodes per cell + i. For sweeps
    /// over one batch.
    CellBatches
    apart() const;

    /// Local numbers of the nodes of a batch, [node][lane].
    const unsigned int *
    nodes(const unsigned int batch) const
    {
      return node_numbers.data() +
             static_cast<std::size_t>(batch) * n_cell_nodes * batch_size;
    }

    /// Whether a batch has the last local node: four numbers must not be read
    /// from there.
    bool
    is_at_end(const unsigned int batch) const
    {
      return at_end[batch] != 0;
    }

    /// Whether sweeps should ask for nodes_to_fetch() ahead: their vectors of
    /// numbers of type T are too large for the caches of a processor core.
    template <typename T>
    bool
    exceed_caches() const
    {
      return n_local_nodes * sizeof(T) > max_cached_nodes * sizeof(double);
    }

    /// Local numbers of the nodes of batches [batch, end) that the 8 *
    /// floats_per_batch batches before do not have, which leaves them far away
    /// from the processor. Only if they exceed_caches<double>(). @p end may be
    /// beyond n_batches() by 2 * floats_per_batch.
    std::span<const unsigned int>
    nodes_to_fetch(const unsigned int batch, const unsigned int end) const
    {
      return {fetched_nodes.data() + fetch_starts[batch],
              fetched_nodes.data() + fetch_starts[end]};
    }

    const std::vector<Chunk> &
    chunks() const
    {
      return plan;
    }

    /// Chunks whose cells may have ghost nodes: [first, second).
    std::pair<unsigned int, unsigned int>
    chunks_with_ghosts() const
    {
      return ghosted_chunks;
    }

  private:
    void
    plan_chunks(const Nodes &nodes);

    void
    plan_fetches(const Nodes &nodes);

    /// A sweep reads three numbers of each node and adds to four. Asking ahead
    /// pays if these take more than 3 MiB: second-level caches have half a
    /// megabyte to two, and those behind them are shared and slower.
    static constexpr unsigned int max_cached_nodes =
      (3 << 20) / (7 * sizeof(double));

    unsigned int               n_cell_nodes;
    unsigned int               n_local_nodes;
    unsigned int               n_owned_cells;
    unsigned int               n_local_cells;
    unsigned int               n_owned;
    std::vector<unsigned int>  node_numbers;
    std::vector<unsigned char> at_end;
    /// nodes_to_fetch() of all batches, and where those of each start; empty
    /// for small bodies.
    std::vector<unsigned int>             fetched_nodes;
    std::vector<unsigned int>             fetch_starts;
    std::vector<Chunk>                    plan;
    std::pair<unsigned int, unsigned int> ghosted_chunks;
    std::shared_ptr<const CurvedBatches>  curved_batches;
  };
} // namespace corotet

#endif
