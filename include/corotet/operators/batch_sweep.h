// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_batch_sweep_h
#define corotet_operators_batch_sweep_h

#include <corotet/discretization/curved_batches.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  /// Prefetches the cache lines of an object that will be read soon.
  template <typename Object>
  COROTET_ALWAYS_INLINE void
  fetch_object(const Object *object)
  {
    const char *const bytes = reinterpret_cast<const char *>(object);
    for (std::size_t i = 0; i < sizeof(Object); i += 64)
      __builtin_prefetch(bytes + i, 0);
  }

  /**
   * The loop over batches of cells around one kind of work: gather, compute,
   * add. It knows neither vectors nor ranks; cell_loop.h does. An Operation has
   *
   *   - Data, what it reads and writes, with a member batches, and Number;
   *   - n_batches, how many batches it takes at once;
   *   - apply(is_curved, data, batch, source, sums): adds to @p sums what the
   *     cells of a batch make of @p source, arrays of the nodes of its chunk.
   *     is_curved is std::true_type or std::false_type, always the latter if
   *     the operation has a member ignores_curvature;
   *   - fetch(data, batch), if it wants to: asks for what it reads of cells.
   *
   * Where the data are larger than the caches, those of the next but one batch
   * are prefetched while a batch is worked on. For short work one batch ahead
   * would be too late. For long work it is early enough, and two take up to
   * half the time more: operations with a member works_long prefetch one.
   */
  template <typename Operation>
  class BatchSweep
  {
  public:
    using Data   = typename Operation::Data;
    using Number = typename Operation::Number;

    /// Treats batches [first, end).
    static void
    run(Data              &data,
        const unsigned int first,
        const unsigned int end,
        const Number      *source,
        Number            *sums)
    {
      if constexpr (requires { Operation::ignores_curvature; })
        run_batches(std::false_type(), data, first, end, source, sums);
      else
        for_straight_and_curved(
          data.batches,
          first,
          end,
          [&](const auto begin, const auto stop, const auto is_curved) {
            run_batches(is_curved, data, begin, stop, source, sums);
          });
    }

  private:
    static constexpr bool works_long = requires { Operation::works_long; };
    static constexpr unsigned int n_batches_ahead =
      (works_long ? 1 : 2) * Operation::n_batches;

    // The function is flattened: all calls are inlined, so that counters are
    // constants and arrays are registers; with calls it is six times slower.
    template <typename IsCurved>
    static __attribute__((flatten)) void
    run_batches(const IsCurved     is_curved,
                Data              &data,
                const unsigned int first,
                const unsigned int end,
                const Number      *source,
                Number            *sums)
    {
      const bool fetches = data.batches.template exceed_caches<Number>();
      for (unsigned int batch = first; batch < end;
           batch += Operation::n_batches)
        {
          if (fetches)
            fetch(data, batch + n_batches_ahead);
          Operation::apply(is_curved, data, batch, source, sums);
        }
    }

    static COROTET_ALWAYS_INLINE void
    fetch(Data &data, const unsigned int batch)
    {
      if constexpr (requires { Operation::fetch(data, batch); })
        if (batch < data.batches.n_owned_batches())
          Operation::fetch(data, batch);
    }
  };

  /// A sweep for an element that is known at run time only: @p choose gets
  /// std::type_identity of its kernel and returns the sweep.
  template <typename T, typename Choose>
  auto
  sweep_of_element(const Element element, const Choose &choose)
  {
    decltype(choose(std::type_identity<FactoredKernel<1, T>>())) result =
      nullptr;
    with_kernel<T>(element,
                   [&](const auto kernel) { result = choose(kernel); });
    return result;
  }
} // namespace corotet

#endif
