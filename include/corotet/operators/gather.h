// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_gather_h
#define corotet_operators_gather_h

#include <corotet/discretization/cell_batches.h>

#include <type_traits>

/**
 * Moves values between arrays of the nodes of a chunk of cells (CellBatches)
 * and registers with one cell per lane.
 *
 * The arrays have four numbers for each node, of which three are used: reading
 * a node is one load, adding to it one load, one addition and one store, none
 * of which crosses cache lines. Registers of nodes are transposed.
 */
namespace corotet
{
  namespace internal
  {
    template <typename V, int... i>
    COROTET_ALWAYS_INLINE auto
    concatenate(const V a, const V b, std::integer_sequence<int, i...>)
    {
      return __builtin_shufflevector(a, b, i...);
    }

    /// The values node(4 b + r), four numbers each, for b from first on.
    template <int n_blocks, typename Node>
    COROTET_ALWAYS_INLINE auto
    row(const Node &node, const int r, const int first = 0)
    {
      if constexpr (n_blocks == 1)
        return node(4 * first + r);
      else
        return concatenate(row<n_blocks / 2>(node, r, first),
                           row<n_blocks / 2>(node, r, first + n_blocks / 2),
                           std::make_integer_sequence<int, 4 * n_blocks>());
    }

    /// Permutes the lanes of a (0 to 3) and b (4 to 7) in each block of four
    /// lanes.
    template <int i0, int i1, int i2, int i3, typename V, int... l>
    COROTET_ALWAYS_INLINE V
    shuffle(const V a, const V b, std::integer_sequence<int, l...>)
    {
      constexpr int n    = sizeof...(l);
      constexpr int i[4] = {i0, i1, i2, i3};
      return __builtin_shufflevector(
        a, b, (l / 4 * 4 + i[l % 4] % 4 + (i[l % 4] < 4 ? 0 : n))...);
    }

    template <int i0, int i1, int i2, int i3, typename V>
    COROTET_ALWAYS_INLINE V
    shuffle_fours(const V a, const V b)
    {
      return shuffle<i0, i1, i2, i3>(
        a, b, std::make_integer_sequence<int, sizeof(V) / sizeof(a[0])>());
    }

    template <int b, typename V, int... l>
    COROTET_ALWAYS_INLINE auto
    block(const V a, std::integer_sequence<int, l...>)
    {
      return __builtin_shufflevector(a, a, (4 * b + l)...);
    }

    /// The place of @p lane's number among those of a node in batches of
    /// n_nodes.
    template <int n_nodes>
    constexpr int
    place_in_batches(const int lane)
    {
      constexpr int size = batch_size;
      return lane / size * n_nodes * size + lane % size;
    }
  } // namespace internal

  /// Gathers the values at the nodes of the register of cells that starts with
  /// @p batch, from an array @p source of its chunk.
  template <int n_nodes, typename T>
  COROTET_ALWAYS_INLINE void
  gather_batch(const CellBatches &batches,
               const unsigned int batch,
               const T           *source,
               Simd<T> (&u)[n_nodes][3])
  {
    using internal::shuffle_fours;
    const std::uint16_t *numbers = batches.nodes(batch);
    for (int i = 0; i < n_nodes; ++i, numbers += batch_size)
      {
        const auto node = [&](const int lane) {
          return load_aligned<4>(
            source + 4 * static_cast<std::size_t>(
                           numbers[internal::place_in_batches<n_nodes>(lane)]));
        };
        // Blocks of 4 x 4 are transposed; their last rows are not used.
        constexpr int n_blocks = n_lanes<T> / 4;
        const Simd<T> r0       = internal::row<n_blocks>(node, 0);
        const Simd<T> r1       = internal::row<n_blocks>(node, 1);
        const Simd<T> r2       = internal::row<n_blocks>(node, 2);
        const Simd<T> r3       = internal::row<n_blocks>(node, 3);
        const Simd<T> xz_01    = shuffle_fours<0, 4, 2, 6>(r0, r1);
        const Simd<T> xz_23    = shuffle_fours<0, 4, 2, 6>(r2, r3);
        u[i][0]                = shuffle_fours<0, 1, 4, 5>(xz_01, xz_23);
        u[i][1] = shuffle_fours<0, 1, 4, 5>(shuffle_fours<1, 5, 3, 7>(r0, r1),
                                            shuffle_fours<1, 5, 3, 7>(r2, r3));
        u[i][2] = shuffle_fours<2, 3, 6, 7>(xz_01, xz_23);
      }
  }

  /// The same minus the value at the first node: gradients do not depend on a
  /// translation, and without it they do not lose digits.
  template <int n_nodes, typename T>
  COROTET_ALWAYS_INLINE void
  gather_differences(const CellBatches &batches,
                     const unsigned int batch,
                     const T           *source,
                     Simd<T> (&u)[n_nodes][3])
  {
    gather_batch<n_nodes>(batches, batch, source, u);
    static_for<3>([&](auto a) {
      const Simd<T> origin = u[0][a];
      static_for<n_nodes>([&](auto i) { u[i][a] -= origin; });
    });
  }

  /// Adds the values of the register of cells that starts with @p batch to an
  /// array @p sums of its chunk.
  template <int n_nodes, typename T>
  COROTET_ALWAYS_INLINE void
  scatter_add(const CellBatches &batches,
              const unsigned int batch,
              const Simd<T> (&v)[n_nodes][3],
              T *sums)
  {
    using internal::shuffle_fours;
    const std::uint16_t *numbers = batches.nodes(batch);
    for (int i = 0; i < n_nodes; ++i, numbers += batch_size)
      {
        const Simd<T> zero{};
        const Simd<T> xy_01   = shuffle_fours<0, 4, 1, 5>(v[i][0], v[i][1]);
        const Simd<T> xy_23   = shuffle_fours<2, 6, 3, 7>(v[i][0], v[i][1]);
        const Simd<T> z_01    = shuffle_fours<0, 4, 1, 5>(v[i][2], zero);
        const Simd<T> z_23    = shuffle_fours<2, 6, 3, 7>(v[i][2], zero);
        const Simd<T> rows[4] = {shuffle_fours<0, 1, 4, 5>(xy_01, z_01),
                                 shuffle_fours<2, 3, 6, 7>(xy_01, z_01),
                                 shuffle_fours<0, 1, 4, 5>(xy_23, z_23),
                                 shuffle_fours<2, 3, 6, 7>(xy_23, z_23)};
        static_for<n_lanes<T>>([&](auto lane) {
          constexpr int r = lane % 4, b = lane / 4;
          T *const      sum =
            sums + 4 * static_cast<std::size_t>(
                         numbers[internal::place_in_batches<n_nodes>(lane)]);
          store_aligned(
            load_aligned<4>(sum) +
              internal::block<b>(rows[r], std::make_integer_sequence<int, 4>()),
            sum);
        });
      }
  }

  namespace internal
  {
    /// Removes the fourth numbers of nodes, which follow each other in
    /// registers of n numbers: returns register @p which of those that the
    /// other numbers fill. @p a and @p b are registers @p which and the next
    /// one.
    template <int which, int n, typename V, int... l>
    COROTET_ALWAYS_INLINE V
    without_fourths(const V a, const V b, std::integer_sequence<int, l...>)
    {
      constexpr auto place = [](const int j) {
        return j / 3 * 4 + j % 3 - which * n;
      };
      return __builtin_shufflevector(a, b, place(which * n + l)...);
    }

    /// take_sums() for as many nodes as a register of @p n numbers has.
    template <int n, typename T, typename Function>
    COROTET_ALWAYS_INLINE void
    take_sums_of(T *sums, const unsigned int first, const Function &function)
    {
      using V            = SimdVector<T, n>;
      constexpr auto all = std::make_integer_sequence<int, n>();
      V              registers[4];
      static_for<4>(
        [&](auto k) { registers[k] = load_aligned<n>(sums + k * n); });
      static_for<3>([&](auto k) {
        function(first + k * n,
                 without_fourths<k, n>(registers[k], registers[k + 1], all));
      });
      static_for<4>([&](auto k) { store_aligned(V{}, sums + k * n); });
    }
  } // namespace internal

  /**
   * Takes the sums of nodes [begin, end), which follow each other in the
   * aligned array @p sums from its start on with four numbers each and are zero
   * afterwards. Calls function(i, y): y is the sum of unknown i, or a
   * SimdVector of those from i on.
   */
  template <typename T, typename Function>
  inline void
  take_sums(T                 *sums,
            const unsigned int begin,
            const unsigned int end,
            const Function    &function)
  {
    // In double precision numbers are taken by four: with eight, the numbers
    // that @p function loads would lie in two cache lines each, which makes
    // explicit steps 7 % slower. In single precision, 16 numbers make
    // p-multigrid 5 % faster.
    constexpr unsigned int n_narrow = 4;
    constexpr unsigned int n_wide =
      std::is_same_v<T, float> ? n_lanes<T> : n_narrow;
    unsigned int n = begin;
    for (; n + n_wide <= end; n += n_wide, sums += 4 * n_wide)
      internal::take_sums_of<n_wide>(sums, 3 * n, function);
    for (; n + n_narrow <= end; n += n_narrow, sums += 4 * n_narrow)
      internal::take_sums_of<n_narrow>(sums, 3 * n, function);
    for (; n < end; ++n, sums += 4)
      for (unsigned int a = 0; a < 3; ++a)
        {
          function(3 * n + a, sums[a]);
          sums[a] = 0;
        }
  }

  /// These load a number or a SimdVector V from memory, and store it.
  template <typename V, typename T>
  COROTET_ALWAYS_INLINE V
  load_as(const T *source)
  {
    V v;
    std::memcpy(&v, source, sizeof(V));
    return v;
  }

  template <typename V, typename T>
  COROTET_ALWAYS_INLINE void
  store_to(const V v, T *target)
  {
    std::memcpy(target, &v, sizeof(V));
  }
} // namespace corotet

#endif
