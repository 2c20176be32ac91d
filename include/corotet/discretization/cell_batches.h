// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_cell_batches_h
#define corotet_discretization_cell_batches_h

#include <corotet/base/simd.h>
#include <corotet/discretization/nodes.h>

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace corotet
{
  class CurvedBatches;

  /// Registers of this many cells are what batches are counted in; a register
  /// of floats holds floats_per_batch batches.
  inline constexpr unsigned int batch_size       = n_lanes<double>;
  inline constexpr unsigned int floats_per_batch = n_lanes<float> / batch_size;

  /**
   * The local cells in batches of batch_size, and the plan of a sweep over
   * them. Owned cells, ghost cells and Nodes::first_cells_of_registers() begin
   * a register of floats. What is before it is filled up: lanes
   * without a cell have nodes of another one and must contribute zeros.
   *
   * A sweep goes from chunk to chunk: batches whose nodes fit into the second
   * level of the caches together. Nodes have a number in each chunk that has
   * them, and sweeps know these numbers only: what they read is copied into an
   * array with four numbers for each node of the chunk, and what they add up is
   * taken from another one (operators/cell_loop.h). So the scattered accesses
   * of cells stay in the cache and need half the memory for numbers, and
   * vectors are read and written from one end to the other.
   */
  class CellBatches
  {
  public:
    /// Batches [first, end). In the chunk the nodes [first_node, n_final) are
    /// the first ones, in this order: they are owned, and no owned cell
    /// contributes to them afterwards. Others follow.
    struct Chunk
    {
      unsigned int first;
      unsigned int end;
      unsigned int first_node;
      unsigned int n_final;
      /// Ranges of open_nodes() and continued_nodes().
      unsigned int first_open;
      unsigned int end_open;
      unsigned int first_continued;
      unsigned int end_continued;

      unsigned int
      n_final_nodes() const
      {
        return n_final - first_node;
      }
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
      return n_all;
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
      auto section = sections.end() - 1;
      while (section->first_cell > cell)
        --section;
      const unsigned int i = cell - section->first_cell;
      return {section->first_batch + i / batch_size, i % batch_size};
    }

    /// First local cell of a batch, and how many cells it has, which may be
    /// none.
    std::pair<unsigned int, unsigned int>
    cells(const unsigned int batch) const;

    /// The same batches as if no cells shared nodes: in each batch, node i of
    /// the cell in lane l has the number l * nodes per cell + i. For sweeps
    /// over one batch; there are no chunks.
    CellBatches
    apart() const;

    /// Numbers of the nodes of a batch in its chunk, [node][lane].
    const std::uint16_t *
    nodes(const unsigned int batch) const
    {
      return node_numbers.data() +
             static_cast<std::size_t>(batch) * n_cell_nodes * batch_size;
    }

    /// Those of a local cell.
    CellNodes
    cell_nodes(const unsigned int cell) const;

    /// Whether sweeps should ask ahead for what they read of the cells: with
    /// vectors of numbers of type T it is too large for the caches of a
    /// processor core.
    template <typename T>
    bool
    exceed_caches() const
    {
      return n_local_nodes * sizeof(T) > max_cached_nodes * sizeof(double);
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

    /// Those of ghost cells; all their nodes are open.
    const std::vector<Chunk> &
    chunks_of_ghosts() const
    {
      return plan_of_ghosts;
    }

    /// The nodes that follow the final ones in a chunk, ascending.
    std::span<const PartialSum>
    open_nodes(const Chunk &chunk) const
    {
      return {open.data() + chunk.first_open, open.data() + chunk.end_open};
    }

    /// The final nodes of a chunk to which chunks before have contributed, by
    /// their numbers in the chunk.
    std::span<const PartialSum>
    continued_nodes(const Chunk &chunk) const
    {
      return {continued.data() + chunk.first_continued,
              continued.data() + chunk.end_continued};
    }

    /// The most that a chunk has.
    unsigned int
    max_chunk_nodes() const
    {
      return most_nodes;
    }

    /// Slots of partial sums. The first ones are those of the owned nodes that
    /// other ranks contribute to and of ghosts, in their order.
    unsigned int
    n_slots() const
    {
      return slots;
    }

  private:
    /// Consecutive cells in consecutive batches.
    struct Section
    {
      unsigned int first_cell;
      unsigned int first_batch;
    };

    void
    make_sections(const std::vector<unsigned int> &first_cells);

    /// First local cell of a batch, and the one after the last of its section,
    /// which may come before.
    std::pair<unsigned int, unsigned int>
    cells_from(const unsigned int batch) const;

    /// Calls function(k, n) for the numbers k among node_numbers of a batch and
    /// the local nodes n that belong there.
    template <typename Function>
    void
    for_nodes(const Nodes       &nodes,
              const unsigned int batch,
              const Function    &function) const;

    /// Divides batches [begin, end) into chunks, also at @p cuts.
    std::vector<Chunk>
    divide(const Nodes                     &nodes,
           const unsigned int               begin,
           const unsigned int               end,
           const std::vector<unsigned int> &cuts) const;

    void
    find_final_nodes(const Nodes &nodes);

    void
    number_nodes(const Nodes &nodes);

    const Chunk &
    chunk_of(const unsigned int batch) const
    {
      const unsigned int c = chunk_of_batch[batch];
      return c < plan.size() ? plan[c] : plan_of_ghosts[c - plan.size()];
    }

    /// What a core has to itself is half a megabyte to two, and what lies
    /// behind that is shared and slower: cells are asked for ahead where
    /// vectors of three and four numbers for each node take more than 3 MiB.
    static constexpr unsigned int max_cached_nodes =
      (3 << 20) / (7 * sizeof(double));

    unsigned int               n_cell_nodes;
    unsigned int               n_local_nodes;
    unsigned int               n_owned_cells;
    unsigned int               n_local_cells;
    unsigned int               n_owned = 0;
    unsigned int               n_all   = 0;
    std::vector<Section>       sections;
    std::vector<std::uint16_t> node_numbers;
    /// Of each batch: its chunk; those of ghost cells are counted on.
    std::vector<unsigned int>             chunk_of_batch;
    std::vector<Chunk>                    plan;
    std::vector<Chunk>                    plan_of_ghosts;
    std::vector<PartialSum>               open;
    std::vector<PartialSum>               continued;
    unsigned int                          most_nodes = 0;
    unsigned int                          slots      = 0;
    std::pair<unsigned int, unsigned int> ghosted_chunks;
    std::shared_ptr<const CurvedBatches>  curved_batches;
  };
} // namespace corotet

#endif
