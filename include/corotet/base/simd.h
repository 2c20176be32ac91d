// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_simd_h
#define corotet_base_simd_h

#include <cstring>
#include <utility>

/// For functions whose arguments fill many of the caller's registers: a call
/// would spill them to memory.
#define COROTET_ALWAYS_INLINE __attribute__((always_inline)) inline

namespace corotet
{
  /**
   * The number of values of type T that a kernel treats at once: as many as a
   * register of this machine holds, at least four (two shorter registers then).
   */
  template <typename T>
  inline constexpr int n_lanes =
#if defined(__AVX512F__)
    64 / sizeof(T);
#elif defined(__AVX__)
    32 / sizeof(T);
#else
    4;
#endif

  /// The instruction set that this is compiled for: the newest of the
  /// extensions that matter.
  inline constexpr const char *instruction_set =
#if defined(__AVX512F__)
    "AVX-512";
#elif defined(__AVX2__)
    "AVX2";
#elif defined(__SSE2__)
    "SSE2";
#else
      "any processor of its kind";
#endif

  namespace internal
  {
    template <typename T, int n>
    struct VectorType
    {
      using type __attribute__((vector_size(n * sizeof(T)))) = T;
    };
  } // namespace internal

  /// A vector of the compiler (GCC, Clang) with @p n elements: + - * / work
  /// lane by lane, [] gives a lane.
  template <typename T, int n>
  using SimdVector = typename internal::VectorType<T, n>::type;

  /// A register of numbers: one lane per cell.
  template <typename T>
  using Simd = SimdVector<T, n_lanes<T>>;

  /// Calls function(integral_constant<int, 0>), .., <n - 1>: a loop that is
  /// unrolled, with a counter that is a constant.
  template <int n, typename Function>
  COROTET_ALWAYS_INLINE void
  static_for(const Function &function)
  {
    [&]<int... i>(std::integer_sequence<int, i...>) {
      (function(std::integral_constant<int, i>()), ...);
    }(std::make_integer_sequence<int, n>());
  }

  /// A register with all lanes equal to @p value.
  template <typename T>
  COROTET_ALWAYS_INLINE Simd<T>
                        broadcast(const T value)
  {
    return Simd<T>{} + value;
  }

  /// Loads n numbers from @p source, which may have any alignment.
  template <int n, typename T>
  COROTET_ALWAYS_INLINE SimdVector<T, n>
                        load_unaligned(const T *source)
  {
    SimdVector<T, n> v;
    std::memcpy(&v, source, sizeof(v));
    return v;
  }

  /// Loads n numbers from an address that is a multiple of their total size.
  template <int n, typename T>
  COROTET_ALWAYS_INLINE SimdVector<T, n>
                        load_aligned(const T *source)
  {
    SimdVector<T, n> v;
    std::memcpy(&v, __builtin_assume_aligned(source, sizeof(v)), sizeof(v));
    return v;
  }

  template <typename V, typename T>
  COROTET_ALWAYS_INLINE void
  store_aligned(const V v, T *target)
  {
    std::memcpy(__builtin_assume_aligned(target, sizeof(v)), &v, sizeof(v));
  }
} // namespace corotet

#endif
