// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_material_polar_decomposition_simd_h
#define corotet_material_polar_decomposition_simd_h

#include <corotet/base/simd.h>
#include <corotet/material/polar_decomposition.h>

#include <cstdint>
#include <cstring>

#ifdef __AVX__
#  include <immintrin.h>
#endif

namespace corotet
{
  /**
   * What polar_decomposition() has found about several F, a bit per lane.
   */
  struct PolarLanes
  {
    /// Lanes that took the scalar function: all that are inverted or
    /// degenerate, and regular ones that are flat or of extreme scale.
    unsigned int irregular = 0;
    /// Lanes with PolarState::inverted.
    unsigned int inverted = 0;
    /// Lanes with PolarState::degenerate.
    unsigned int degenerate = 0;

    /// Adds the lanes of @p other.
    COROTET_ALWAYS_INLINE void
    operator|=(const PolarLanes &other)
    {
      irregular |= other.irregular;
      inverted |= other.inverted;
      degenerate |= other.degenerate;
    }
  };

  namespace internal
  {
    using SimdMask   = SimdVector<std::int64_t, n_lanes<double>>;
    using SimdMatrix = Simd<double>[3][3];

    /// A bit per lane that is true (all ones).
    COROTET_ALWAYS_INLINE unsigned int
    lane_bits(const SimdMask &mask)
    {
#if defined(__AVX512DQ__)
      __m512i lanes;
      std::memcpy(&lanes, &mask, sizeof(mask));
      return _mm512_movepi64_mask(lanes);
#elif defined(__AVX__) && !defined(__AVX512F__)
      __m256d lanes;
      std::memcpy(&lanes, &mask, sizeof(mask));
      return _mm256_movemask_pd(lanes);
#else
      unsigned int bits = 0;
      for (int lane = 0; lane < n_lanes<double>; ++lane)
        bits |= (mask[lane] != 0 ? 1u : 0u) << lane;
      return bits;
#endif
    }

    /// X <- 1 / sqrt(X) for normal X > 0: a guess from the bits, relative error
    /// 3.5e-2, and @p n_steps of Newton's iteration (1.8e-3, 4.8e-6, ..).
    template <int n_steps>
    COROTET_ALWAYS_INLINE void
    approximate_rsqrt(Simd<double> &x)
    {
      SimdVector<std::uint64_t, n_lanes<double>> bits;
      std::memcpy(&bits, &x, sizeof(x));
      bits = 0x5fe6eb50c7b537a9u - (bits >> 1);
      Simd<double> y;
      std::memcpy(&y, &bits, sizeof(y));
      static_for<n_steps>([&](auto) { y *= 1.5 - 0.5 * x * y * y; });
      x = y;
    }

    COROTET_ALWAYS_INLINE void
    copy(const SimdMatrix &source, SimdMatrix &target)
    {
      static_for<9>([&](auto ij) {
        constexpr int i = ij / 3, j = ij % 3;
        target[i][j] = source[i][j];
      });
    }

    /// X <- a X + b C.
    COROTET_ALWAYS_INLINE void
    combine(const Simd<double> &a,
            SimdMatrix         &X,
            const Simd<double> &b,
            const SimdMatrix   &C)
    {
      static_for<9>([&](auto ij) {
        constexpr int i = ij / 3, j = ij % 3;
        X[i][j] = a * X[i][j] + b * C[i][j];
      });
    }

    /// Matrix of cofactors, C = det(X) X^{-T}, and det(X).
    COROTET_ALWAYS_INLINE void
    cofactors(const SimdMatrix &X, SimdMatrix &C, Simd<double> &det)
    {
      static_for<9>([&](auto ij) {
        constexpr int i = ij / 3, i1 = (i + 1) % 3, i2 = (i + 2) % 3;
        constexpr int j = ij % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        C[i][j] = X[i1][j1] * X[i2][j2] - X[i1][j2] * X[i2][j1];
      });
      det = X[0][0] * C[0][0] + X[0][1] * C[0][1] + X[0][2] * C[0][2];
    }

    COROTET_ALWAYS_INLINE void
    norm_square(const SimdMatrix &X, Simd<double> &result)
    {
      Simd<double> row[3];
      static_for<3>([&](auto i) {
        row[i] = X[i][0] * X[i][0] + X[i][1] * X[i][1] + X[i][2] * X[i][2];
      });
      result = row[0] + row[1] + row[2];
    }

    /// X <- a (X + w C): w makes the two equally large, a gives the sum the
    /// norm of a rotation. @p f is |X|^2, @p d is det X.
    COROTET_ALWAYS_INLINE void
    balanced_step(SimdMatrix         &X,
                  const SimdMatrix   &C,
                  const Simd<double> &f,
                  const Simd<double> &d)
    {
      Simd<double> c;
      norm_square(C, c);
      Simd<double> w = f * c;
      approximate_rsqrt<1>(w);
      w *= f;
      // |X + w C|^2 / 3, where X : C = 3 det X.
      Simd<double> a = (f + w * (w * c + 6. * d)) * (1. / 3);
      approximate_rsqrt<2>(a);
      combine(a, X, a * w, C);
    }

    /// X <- (X + X^{-T}) / 2 where e = 1 - det X is small, 1/det X =
    /// 1 + e + e^2.
    COROTET_ALWAYS_INLINE void
    newton_step(SimdMatrix &X)
    {
      SimdMatrix   C;
      Simd<double> d;
      cofactors(X, C, d);
      const Simd<double> e = 1. - d;
      combine(Simd<double>{} + 0.5, X, 0.5 + 0.5 * e * (1. + e), C);
    }

    /// Lanes with det F > 1e-3 |F|^3 > 0, where nothing overflows. NaN is not
    /// among them.
    COROTET_ALWAYS_INLINE unsigned int
    ordinary_lanes(const Simd<double> &f, const Simd<double> &d)
    {
      return lane_bits((f > 1e-30) & (f < 1e30) & (d > 0.) &
                       (d * d > 1e-6 * f * f * f));
    }

    /// The largest 1 - det X for which three steps are enough. With |X|^2 = 3
    /// it is the sum of (s - 1)^2 over the singular values s, to leading order.
    constexpr double far_from_rotation = 1.75e-3;

    /// Balanced steps for the lanes of @p lanes that need more than one.
    /// Returns those that are still far from a rotation after six.
    inline __attribute__((noinline)) unsigned int
    balance(const unsigned int lanes, SimdMatrix &X) noexcept
    {
      for (unsigned int k = 0;; ++k)
        {
          SimdMatrix   C, next;
          Simd<double> d, f;
          cofactors(X, C, d);
          const SimdMask     is_far   = ~(1. - d < far_from_rotation);
          const unsigned int far_ones = lane_bits(is_far) & lanes;
          if (far_ones == 0 || k == 6)
            return far_ones;
          copy(X, next);
          norm_square(X, f);
          balanced_step(next, C, f, d);
          // Other lanes keep their values: the result of a lane must not depend
          // on those of others.
          static_for<9>([&](auto ij) {
            constexpr int i = ij / 3, j = ij % 3;
            X[i][j] = is_far ? next[i][j] : X[i][j];
          });
        }
    }

    /// Calls the scalar function for the lanes of @p lanes.
    inline __attribute__((noinline, cold)) PolarLanes
    polar_decomposition_by_lane(const unsigned int lanes,
                                const SimdMatrix  &F,
                                SimdMatrix        &R)
    {
      PolarLanes result;
      result.irregular = lanes;
      for (int lane = 0; lane < n_lanes<double>; ++lane)
        if ((lanes >> lane & 1u) != 0)
          {
            dealii::Tensor<2, 3> F_of_lane;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                F_of_lane[i][j] = F[i][j][lane];
            const PolarDecomposition polar = polar_decomposition(F_of_lane);
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                R[i][j][lane] = polar.rotation[i][j];
            if (polar.state == PolarState::inverted)
              result.inverted |= 1u << lane;
            if (polar.state == PolarState::degenerate)
              result.degenerate |= 1u << lane;
          }
      return result;
    }
  } // namespace internal

  /**
   * The rotations of n_lanes<double> deformation gradients F[i][j] at once, as
   * polar_decomposition() gives them one by one: of any F, R^T R = I and
   * det R = 1 to 1e-14. A lane's result is the same, bit by bit, whatever the
   * other lanes hold. @p R may be @p F.
   *
   * a X + b C, with C the cofactors of X and a, b > 0, has the rotation of X:
   * Newton's iteration (X + X^{-T}) / 2 is one choice [Higham 1986]. Four steps
   * without a division or root are enough for principal stretches in
   * [0.7, 1.3], at any scale:
   *  1. X and C weighted by their norms, the sum scaled to norm sqrt(3). Lanes
   *     with larger stretches repeat this one.
   *  2. (4 - det X) / 6 (X + C), which halves Newton's error, as it leaves the
   *     singular values on both sides of 1 instead of above.
   *  3. and 4. Newton's, with a series for 1 / det X.
   * The lanes for which that is not good take the scalar function, a hundred
   * times slower: det F <= 1e-3 |F|^3 (Frobenius norm), |F| beyond 1e+-15, not
   * finite.
   */
  COROTET_ALWAYS_INLINE PolarLanes
  polar_decomposition(const Simd<double> (&F)[3][3], Simd<double> (&R)[3][3])
  {
    Simd<double> X[3][3], C[3][3], f, d;
    internal::copy(F, X);
    internal::cofactors(X, C, d);
    internal::norm_square(X, f);
    unsigned int ordinary = internal::ordinary_lanes(f, d);
    internal::balanced_step(X, C, f, d);

    internal::cofactors(X, C, d);
    const unsigned int far_ones =
      internal::lane_bits(~(1. - d < internal::far_from_rotation)) & ordinary;
    // The rarely called functions get copies, so that X and the caller's F and
    // R stay in registers.
    if (__builtin_expect(static_cast<long>(far_ones != 0), 0))
      {
        Simd<double> Y[3][3];
        internal::copy(X, Y);
        ordinary &= ~internal::balance(ordinary, Y);
        internal::copy(Y, X);
        internal::cofactors(X, C, d);
      }
    const Simd<double> a = (4. - d) * (1. / 6);
    internal::combine(a, X, a, C);
    internal::newton_step(X);
    internal::newton_step(X);

    PolarLanes         result;
    const unsigned int irregular = ~ordinary & ((1u << n_lanes<double>)-1);
    if (__builtin_expect(static_cast<long>(irregular != 0), 0))
      {
        Simd<double> G[3][3], Y[3][3];
        internal::copy(F, G);
        internal::copy(X, Y);
        result = internal::polar_decomposition_by_lane(irregular, G, Y);
        internal::copy(Y, X);
      }
    internal::copy(X, R);
    return result;
  }
} // namespace corotet

#endif
