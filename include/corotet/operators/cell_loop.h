// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_cell_loop_h
#define corotet_operators_cell_loop_h

#include <corotet/discretization/nodes.h>
#include <corotet/operators/gather.h>

#include <deal.II/base/aligned_vector.h>
#include <deal.II/base/mpi.h>

namespace corotet
{
  /**
   * Sweeps over the owned cells whose contributions to nodes are summed up,
   * over all ranks. Values of ghosts travel to the ranks that need them, and
   * contributions to ghosts back to their owners, while cells without ghosts
   * are worked on. Sums are handed on, chunk by chunk, as soon as they are
   * complete.
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
      , sums(space->sums)
      , exchange(space->exchange)
    {}

    /**
     * Runs over all batches of owned cells.
     *
     * @p add(first, end, source, sums) adds what batches [first, end)
     * contribute to the array sums, four numbers per local node; source are the
     * local values of @p src. @p take(i, y) gets the sum y of the owned unknown
     * i, or those of several from i on (see take_sums()); it may change @p src
     * there. Ghost entries of @p src are brought up to date if they are not in
     * use, and left as they came. Collective.
     */
    template <typename Add, typename Take>
    void
    run(const VectorType &src, const Add &add, const Take &take) const
    {
      const bool         fetch    = is_distributed && !src.has_ghost_elements();
      const CellBatches &batches  = nodes.batches();
      const auto         ghosted  = batches.chunks_with_ghosts();
      const unsigned int n_chunks = batches.chunks().size();
      unsigned int       n_taken  = 0;
      const auto sweep = [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int c = begin; c < end; ++c)
          {
            const CellBatches::Chunk &chunk = batches.chunks()[c];
            add(chunk.first, chunk.end, src.begin(), sums.data());
            take_sums(sums.data(), n_taken, chunk.n_final, take);
            n_taken = chunk.n_final;
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
      take_sums(sums.data(), n_taken, nodes.n_owned_nodes(), take);
      if (fetch)
        src.zero_out_ghost_values();
    }

    const Nodes &
    get_nodes() const
    {
      return nodes;
    }

  private:
    void
    send_contributions() const
    {
      take_sums(sums.data(),
                nodes.n_owned_nodes(),
                nodes.n_local_nodes(),
                [&](const unsigned int i, const auto y) {
                  store_to(y, exchange.begin() + i);
                });
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
            sums[4 * static_cast<std::size_t>(n) + a] += contribution;
            contribution = 0;
          }
    }

    /// Loops over the same cells take turns.
    struct Space
    {
      explicit Space(const Nodes &nodes)
        : sums(4 * static_cast<std::size_t>(nodes.n_local_nodes()))
      {
        if (dealii::Utilities::MPI::n_mpi_processes(nodes.communicator()) > 1)
          nodes.initialize_vector(exchange);
      }

      /// Four numbers per local node; all zero between sweeps.
      dealii::AlignedVector<T> sums;
      /// Owned entries are zero but between receiving and handing on. Empty on
      /// one rank.
      VectorType exchange;
    };

    const Nodes                 &nodes;
    const bool                   is_distributed;
    const std::shared_ptr<Space> space;
    dealii::AlignedVector<T>    &sums;
    VectorType                  &exchange;
  };
} // namespace corotet

#endif
