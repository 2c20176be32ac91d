// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_cell_loop_h
#define corotet_operators_cell_loop_h

#include <corotet/discretization/nodes.h>
#include <corotet/operators/gather.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <vector>

namespace corotet
{
  namespace internal
  {
    /// Rearranges groups of three numbers, from the start of a register on,
    /// into groups of four; the fourth number is that of the next group.
    template <typename V, int... l>
    COROTET_ALWAYS_INLINE V
    threes_to_fours(const V a, std::integer_sequence<int, l...>)
    {
      return __builtin_shufflevector(a, a, (l / 4 * 3 + l % 4)...);
    }

    /// Copies @p n nodes from a vector with three numbers for each to an
    /// aligned array with four.
    template <typename T>
    COROTET_ALWAYS_INLINE void
    copy_to_fours(const T *vector, const unsigned int n, T *fours)
    {
      constexpr int          lanes = n_lanes<T>;
      constexpr unsigned int step  = lanes / 4;
      unsigned int           k     = 0;
      for (; 3 * k + lanes <= 3 * n;
           k += step, vector += 3 * step, fours += lanes)
        store_aligned(threes_to_fours(load_unaligned<lanes>(vector),
                                      std::make_integer_sequence<int, lanes>()),
                      fours);
      for (; k < n; ++k, vector += 3, fours += 4)
        std::copy_n(vector, 3, fours);
    }
  } // namespace internal

  /// Copies the nodes of a chunk of cells from a vector of all local nodes to
  /// an array of the chunk.
  template <typename T>
  inline void
  load_chunk(const CellBatches        &batches,
             const CellBatches::Chunk &chunk,
             const T                  *vector,
             T                        *values)
  {
    const unsigned int n_final = chunk.n_final_nodes();
    internal::copy_to_fours(
      vector + 3 * static_cast<std::size_t>(chunk.first_node), n_final, values);
    const auto open = batches.open_nodes(chunk);
    values += 4 * static_cast<std::size_t>(n_final);
    for (std::size_t k = 0; k < open.size(); ++k, values += 4)
      {
        const T *const node =
          vector + 3 * static_cast<std::size_t>(open[k].node);
        // Open nodes ascend: all but the last one have a fourth number behind
        // them.
        if (k + 1 < open.size())
          store_aligned(load_unaligned<4>(node), values);
        else
          std::copy_n(node, 3, values);
      }
  }

  /// target += source, for four numbers; the source is zero afterwards.
  template <typename T>
  COROTET_ALWAYS_INLINE void
  move_sum(T *source, T *target)
  {
    store_aligned(load_aligned<4>(target) + load_aligned<4>(source), target);
    store_aligned(SimdVector<T, 4>{}, source);
  }

  /**
   * Sweeps over the cells, chunk by chunk, whose contributions to nodes are
   * summed up over all ranks. Values of ghosts travel to the ranks that need
   * them, and contributions to ghosts back to their owners, while cells without
   * ghosts are worked on. Sums are handed on, chunk by chunk, as soon as they
   * are complete; those of nodes that belong to other chunks, too, are kept
   * until then.
   *
   * @p nodes must outlive this object.
   */
  template <typename T>
  class CellLoop
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<T>;

    explicit CellLoop(const Nodes &nodes)
      : nodes(nodes)
      , is_distributed(
          dealii::Utilities::MPI::n_mpi_processes(nodes.communicator()) > 1)
      , space(nodes.work_space<Space>())
      , partial_sums(space->partial_sums)
      , exchange(space->exchange)
    {}

    /**
     * Runs over all owned cells.
     *
     * @p add(chunk, source, sums) adds the contributions of a chunk's batches
     * to its array sums; source is the array of its values of @p src.
     * @p take(i, y) gets the sum y of the owned unknown i, or those of several
     * from i on (see take_sums()); it may change @p src there. Ghost entries of
     * @p src are brought up to date if they are not in use, and left as they
     * came. Collective.
     */
    template <typename Add, typename Take>
    void
    run(const VectorType &src, const Add &add, const Take &take) const
    {
      const bool         fetch    = is_distributed && !src.has_ghost_elements();
      const CellBatches &batches  = nodes.batches();
      const auto         ghosted  = batches.chunks_with_ghosts();
      const unsigned int n_chunks = batches.chunks().size();
      const auto sweep = [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int c = begin; c < end; ++c)
          {
            const CellBatches::Chunk &chunk = batches.chunks()[c];
            T *const                  sums  = space->sums.data();
            load_chunk(batches, chunk, src.begin(), space->values.data());
            add(chunk, static_cast<const T *>(space->values.data()), sums);
            keep_partial_sums(chunk);
            take_sums(sums, chunk.first_node, chunk.n_final, take);
          }
      };

      if (fetch)
        src.update_ghost_values_start(0);
      sweep(0, ghosted.first);
      if (fetch)
        src.update_ghost_values_finish();
      sweep(ghosted.first, ghosted.second);
      if (is_distributed)
        send_contributions();
      sweep(ghosted.second, n_chunks);
      if (is_distributed)
        receive_contributions();
      take_sums(partial_sums.data(),
                nodes.first_shared_node(),
                nodes.n_owned_nodes(),
                take);
      if (fetch)
        src.zero_out_ghost_values();
    }

    /// Calls @p read(chunk, source) for chunks of owned or of ghost cells;
    /// source is the array of the values of @p src, whose ghosts must be up to
    /// date. Not collective.
    template <typename Read>
    void
    read(const std::vector<CellBatches::Chunk> &chunks,
         const VectorType                      &src,
         const Read                            &read) const
    {
      for (const CellBatches::Chunk &chunk : chunks)
        {
          load_chunk(nodes.batches(), chunk, src.begin(), space->values.data());
          read(chunk, static_cast<const T *>(space->values.data()));
        }
    }

    const Nodes &
    get_nodes() const
    {
      return nodes;
    }

  private:
    /// For nodes that also belong to other chunks: adds what these have
    /// contributed to final sums, and stores this chunk's contributions for
    /// others.
    void
    keep_partial_sums(const CellBatches::Chunk &chunk) const
    {
      const CellBatches &batches = nodes.batches();
      T *const           sums    = space->sums.data();
      T *sum = sums + 4 * static_cast<std::size_t>(chunk.n_final_nodes());
      for (const PartialSum &open : batches.open_nodes(chunk))
        {
          move_sum(sum, &partial_sums[4 * static_cast<std::size_t>(open.slot)]);
          sum += 4;
        }
      for (const PartialSum &continued : batches.continued_nodes(chunk))
        move_sum(&partial_sums[4 * static_cast<std::size_t>(continued.slot)],
                 sums + 4 * static_cast<std::size_t>(continued.node));
    }

    /// The partial sum of a node: shared owned nodes come first, then ghosts.
    T *
    partial_sum(const unsigned int node) const
    {
      return partial_sums.data() +
             4 * static_cast<std::size_t>(node - nodes.first_shared_node());
    }

    void
    send_contributions() const
    {
      for (unsigned int n = nodes.n_owned_nodes(); n < nodes.n_local_nodes();
           ++n)
        for (unsigned int a = 0; a < 3; ++a)
          {
            T &sum                          = partial_sum(n)[a];
            *(exchange.begin() + 3 * n + a) = sum;
            sum                             = 0;
          }
      exchange.compress_start(1, dealii::VectorOperation::add);
    }

    void
    receive_contributions() const
    {
      exchange.compress_finish(dealii::VectorOperation::add);
      for (unsigned int n = nodes.first_shared_node();
           n < nodes.n_owned_nodes();
           ++n)
        for (unsigned int a = 0; a < 3; ++a)
          {
            T &contribution = *(exchange.begin() + 3 * n + a);
            partial_sum(n)[a] += contribution;
            contribution = 0;
          }
    }

    /// Work space, which loops over the same cells use in turn. Each node has
    /// four numbers.
    struct Space
    {
      explicit Space(const Nodes &nodes)
        : values(4 *
                 static_cast<std::size_t>(nodes.batches().max_chunk_nodes()))
        , sums(values.size())
        , partial_sums(4 * static_cast<std::size_t>(nodes.batches().n_slots()))
      {
        if (dealii::Utilities::MPI::n_mpi_processes(nodes.communicator()) > 1)
          nodes.initialize_vector(exchange);
      }

      /// Values of the nodes of the present chunk.
      dealii::AlignedVector<T> values;
      /// Sums of the nodes of the present chunk; all zero between chunks.
      dealii::AlignedVector<T> sums;
      /// Partial sums, see CellBatches; all zero between sweeps.
      dealii::AlignedVector<T> partial_sums;
      /// Vector for the exchange of ghosts. Owned entries are zero except
      /// between receiving and handing on. Empty on one rank.
      VectorType exchange;
    };

    const Nodes                 &nodes;
    const bool                   is_distributed;
    const std::shared_ptr<Space> space;
    dealii::AlignedVector<T>    &partial_sums;
    VectorType                  &exchange;
  };
} // namespace corotet

#endif
