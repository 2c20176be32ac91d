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

  /// The number of cells in a batch; a register of floats holds
  /// floats_per_batch batches.
  inline constexpr unsigned int batch_size       = n_lanes<double>;
  inline constexpr unsigned int floats_per_batch = n_lanes<float> / batch_size;

  /**
   * The local cells in batches of batch_size, and the plan of a sweep over
   * them. Owned cells, ghost cells and Nodes::first_cells_of_registers() each
   * begin a new register of floats. The register before is filled up: lanes
   * without a cell have the nodes of another cell and must contribute zeros.
   *
   * A sweep goes from chunk to chunk: batches whose nodes fit into the
   * second-level cache together. A node has a number in each chunk that has it,
   * and sweeps use only these numbers: their input is copied into an array with
   * four numbers for each node of the chunk, and their output is taken from
   * another such array (operators/cell_loop.h). So the scattered accesses of
   * cells stay in the cache, numbers need half the memory, and vectors are read
   * and written from one end to the other.
   */
  class CellBatches
  {
  public:
    /// The batches [first, end). The first nodes of the chunk are the final
    /// ones, [first_node, n_final), in this order: they are owned, and no later
    /// owned cell contributes to them. The other nodes follow.
    struct Chunk
    {
      unsigned int first;
      unsigned int end;
      unsigned int first_node;
      unsigned int n_final;
      /// Ranges in open_nodes() and continued_nodes().
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

    /// The number of batches of owned cells, a multiple of floats_per_batch;
    /// those of ghost cells follow.
    unsigned int
    n_owned_batches() const
    {
      return n_owned;
    }

    /// The number of batches of owned and ghost cells.
    unsigned int
    n_batches() const
    {
      return n_all;
    }

    /// The data of batches with curved cells; null if no cell of the rank is
    /// curved.
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

    /// The batch and lane of a local cell.
    std::pair<unsigned int, unsigned int>
    place(const unsigned int cell) const
    {
      auto section = sections.end() - 1;
      while (section->first_cell > cell)
        --section;
      const unsigned int i = cell - section->first_cell;
      return {section->first_batch + i / batch_size, i % batch_size};
    }

    /// The first local cell of a batch, and its number of cells, which may be
    /// zero.
    std::pair<unsigned int, unsigned int>
    cells(const unsigned int batch) const;

    /// The same batches as if no cells shared nodes: in each batch, node i of
    /// the cell in lane l has the number l * nodes per cell + i. For sweeps
    /// over one batch; there are no chunks.
    CellBatches
    apart() const;

    /// The numbers of the nodes of a batch in its chunk, [node][lane].
    const std::uint16_t *
    nodes(const unsigned int batch) const
    {
      return node_numbers.data() +
             static_cast<std::size_t>(batch) * n_cell_nodes * batch_size;
    }

    /// The nodes of a local cell.
    CellNodes
    cell_nodes(const unsigned int cell) const;

    /// Whether sweeps should prefetch what they read of the cells: with vectors
    /// of numbers of type T it is too large for the caches of a processor core.
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

    /// The chunks whose cells may have ghost nodes: [first, second).
    std::pair<unsigned int, unsigned int>
    chunks_with_ghosts() const
    {
      return ghosted_chunks;
    }

    /// The chunks of ghost cells; all their nodes are open.
    const std::vector<Chunk> &
    chunks_of_ghosts() const
    {
      return plan_of_ghosts;
    }

    /// The nodes that follow the final nodes in a chunk, in ascending order.
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

    /// The largest number of nodes in a chunk.
    unsigned int
    max_chunk_nodes() const
    {
      return most_nodes;
    }

    /// The number of slots of partial sums. The first slots belong to owned
    /// nodes that other ranks contribute to, and to ghost nodes, in their
    /// order.
    unsigned int
    n_slots() const
    {
      return slots;
    }

  private:
    /// A range of consecutive cells in consecutive batches.
    struct Section
    {
      unsigned int first_cell;
      unsigned int first_batch;
    };

    void
    make_sections(const std::vector<unsigned int> &first_cells);

    /// The first local cell of a batch, and the end of the cells of its
    /// section, which may come before if the batch has no cells.
    std::pair<unsigned int, unsigned int>
    cells_from(const unsigned int batch) const;

    /// Calls function(k, n) for each place k in node_numbers that belongs to
    /// the batch, and its local node n.
    template <typename Function>
    void
    for_nodes(const Nodes       &nodes,
              const unsigned int batch,
              const Function    &function) const;

    /// Divides the batches [begin, end) into chunks; chunks also begin at @p
    /// cuts.
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

    /// A core has half a megabyte to two of cache to itself; the next level is
    /// shared and slower. Cells are prefetched where vectors of three and four
    /// numbers for each node take more than 3 MiB.
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
    /// The chunk of each batch; the numbers of chunks of ghost cells follow.
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
