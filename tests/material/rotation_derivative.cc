// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The derivative of a rotation: compared with dense inverses and with
// differences of polar decompositions, and where it is clamped.

#include <corotet/material/polar_decomposition.h>
#include <corotet/material/rotation_derivative.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

#include "../body.h"

namespace
{
  using namespace corotet;
  using namespace corotet::tests;
  using dealii::Tensor;

  constexpr int width = n_lanes<double>;

  // A symmetric tensor in each lane, and its inverse operator.
  struct Stretches
  {
    Simd<double> S[6], inverse[6];
    unsigned int clamped = 0;

    void
    set(const int lane, const Tensor<2, 3> &stretch)
    {
      for (unsigned int s = 0; s < 6; ++s)
        S[s][lane] = stretch[internal::symmetric_pairs[s][0]]
                            [internal::symmetric_pairs[s][1]];
    }

    void
    invert()
    {
      clamped = inverse_spin_tensor(S, inverse);
    }

    Tensor<2, 3>
    result(const int lane) const
    {
      Tensor<2, 3> matrix;
      for (unsigned int s = 0; s < 6; ++s)
        {
          const unsigned int a = internal::symmetric_pairs[s][0],
                             b = internal::symmetric_pairs[s][1];
          matrix[a][b] = matrix[b][a] = inverse[s][lane];
        }
      return matrix;
    }

    bool
    is_clamped(const int lane) const
    {
      return (clamped >> lane & 1u) != 0;
    }
  };

  class Random
  {
  public:
    double
    operator()(const double from, const double to)
    {
      return std::uniform_real_distribution<double>(from, to)(generator);
    }

    Tensor<2, 3>
    rotation()
    {
      return rotation_about(
        Tensor<1, 3>({(*this)(-1, 1), (*this)(-1, 1), (*this)(-1, 1) + 1e-3}),
        (*this)(0, dealii::numbers::PI));
    }

    Tensor<2, 3>
    matrix()
    {
      Tensor<2, 3> result;
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          result[a][b] = (*this)(-1, 1);
      return result;
    }

  private:
    std::mt19937 generator{1};
  };

  Tensor<2, 3>
  diagonal(const double s0, const double s1, const double s2)
  {
    Tensor<2, 3> S;
    S[0][0] = s0;
    S[1][1] = s1;
    S[2][2] = s2;
    return S;
  }

  // The matrix tr(S) I - S.
  Tensor<2, 3>
  spin(const Tensor<2, 3> &S)
  {
    Tensor<2, 3> G = -S;
    for (unsigned int a = 0; a < 3; ++a)
      G[a][a] += trace(S);
    return G;
  }

  Tensor<2, 3>
  identity()
  {
    return diagonal(1, 1, 1);
  }
} // namespace

// Stretches from 0.2 to 3: the condition number of G is below 15, so that a
// closed formula loses two digits at most.
TEST(RotationDerivative, InverseOfOrdinaryStretches)
{
  Random random;
  double largest = 0;
  for (unsigned int k = 0; k < 1000; ++k)
    {
      Stretches    stretches;
      Tensor<2, 3> S[width];
      for (int lane = 0; lane < width; ++lane)
        {
          const Tensor<2, 3> Q = random.rotation();
          S[lane]              = symmetrize(
            Q * diagonal(random(0.2, 3), random(0.2, 3), random(0.2, 3)) *
            transpose(Q));
          stretches.set(lane, S[lane]);
        }
      stretches.invert();
      EXPECT_EQ(stretches.clamped, 0u);
      for (int lane = 0; lane < width; ++lane)
        largest =
          std::max(largest,
                   (stretches.result(lane) - invert(spin(S[lane]))).norm() /
                     invert(spin(S[lane])).norm());
    }
  report("largest relative difference", largest);
  EXPECT_LE(largest, 1e-13);
}

// In one lane, two stretches nearly sum to zero: that sum is replaced by the
// smallest one allowed, while other sums, and other lanes to the last bit, do
// not change.
TEST(RotationDerivative, ClampedWhereStretchesSumToZero)
{
  Random random;
  for (const double sum : {-0.2, -1e-9, 0., 1e-9, 0.009})
    for (int bad = 0; bad < width; ++bad)
      {
        Stretches          clean, mixed;
        const Tensor<2, 3> Q = random.rotation();
        for (int lane = 0; lane < width; ++lane)
          {
            const Tensor<2, 3> P = random.rotation();
            const Tensor<2, 3> S =
              symmetrize(P * diagonal(1.2, 0.9, random(0.1, 1)) * transpose(P));
            clean.set(lane, S);
            mixed.set(lane, S);
          }
        const double s0 = 2, s1 = 0.8, s2 = sum - s1;
        mixed.set(bad, symmetrize(Q * diagonal(s0, s1, s2) * transpose(Q)));
        clean.invert();
        mixed.invert();
        EXPECT_EQ(clean.clamped, 0u);
        EXPECT_EQ(mixed.clamped, 1u << bad) << sum;
        const Tensor<2, 3> expected = Q *
                                      diagonal(1 / smallest_sum_of_stretches,
                                               1 / (s0 + s2),
                                               1 / (s0 + s1)) *
                                      transpose(Q);
        EXPECT_LE((mixed.result(bad) - expected).norm(),
                  1e-13 * expected.norm())
          << sum;
        for (int lane = 0; lane < width; ++lane)
          if (lane != bad)
            {
              const Tensor<2, 3> a = clean.result(lane), b = mixed.result(lane);
              // Nine numbers without gaps, whose bits are what is compared.
              // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison)
              EXPECT_EQ(std::memcmp(&a, &b, sizeof(a)), 0) << lane;
            }
      }
}

// Sums just above the smallest one are not clamped, in either way to invert.
TEST(RotationDerivative, NotClampedAboveThat)
{
  for (const double sum : {0.011, 0.02, 0.1, 0.5})
    {
      Stretches          stretches;
      const Tensor<2, 3> S = diagonal(1.5, 0.8, sum - 0.8);
      for (int lane = 0; lane < width; ++lane)
        stretches.set(lane, S);
      stretches.invert();
      EXPECT_EQ(stretches.clamped, 0u) << sum;
      EXPECT_LE((stretches.result(0) * spin(S) - identity()).norm(), 1e-12)
        << sum;
    }
}

// A cell that has collapsed to a point has zero stretches: all sums are
// clamped.
TEST(RotationDerivative, Collapsed)
{
  Stretches stretches;
  for (int lane = 0; lane < width; ++lane)
    stretches.set(lane, Tensor<2, 3>());
  stretches.invert();
  EXPECT_EQ(stretches.clamped, (1u << width) - 1);
  EXPECT_LE((stretches.result(width - 1) -
             identity() / smallest_sum_of_stretches)
              .norm(),
            1e-11);
}

TEST(RotationDerivative, NotFinite)
{
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
    for (unsigned int s = 0; s < 6; ++s)
      {
        Stretches stretches;
        for (int lane = 0; lane < width; ++lane)
          stretches.set(lane, identity());
        stretches.S[s][1] = bad;
        stretches.invert();
        EXPECT_EQ(stretches.clamped, 2u);
        EXPECT_EQ(stretches.result(1), (Tensor<2, 3>()));
        EXPECT_LE((stretches.result(0) - 0.5 * identity()).norm(), 1e-15);
      }
}

// dR = R W(G^{-1} a(R^T dF)) with the functions that kernels use. Central
// differences of fourth order with a step of 1e-3 have errors of some 1e-11.
TEST(RotationDerivative, DifferencesOfPolarDecompositions)
{
  Random random;
  for (const bool inverted : {false, true})
    {
      double largest = 0;
      for (unsigned int k = 0; k < 200; ++k)
        {
          const Tensor<2, 3> U = random.rotation(), V = random.rotation();
          // All sums of two stretches are 0.5 or more.
          const Tensor<2, 3> F =
            U *
            diagonal(random(1.2, 2),
                     random(1, 1.2),
                     inverted ? random(-0.5, -0.2) : random(0.2, 1)) *
            transpose(V);
          const Tensor<2, 3>       dF   = random.matrix();
          const PolarDecomposition here = polar_decomposition(F);
          ASSERT_EQ(here.state,
                    inverted ? PolarState::inverted : PolarState::regular);
          const double h = 1e-3;
          Tensor<2, 3> difference;
          for (const auto &[step, weight] :
               {std::pair<double, double>{-2, 1. / 12},
                {-1, -2. / 3},
                {1, 2. / 3},
                {2, -1. / 12}})
            difference +=
              weight / h * polar_decomposition(F + step * h * dF).rotation;

          const Tensor<2, 3> R = here.rotation;
          const Tensor<2, 3> S = transpose(R) * F, A = transpose(R) * dF;
          Stretches          stretches;
          Simd<double>       A_lanes[3][3], a[3], w[3], W[3][3] = {};
          for (int lane = 0; lane < width; ++lane)
            stretches.set(lane, symmetrize(S));
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              A_lanes[i][j] = broadcast(A[i][j]);
          stretches.invert();
          EXPECT_EQ(stretches.clamped, 0u);
          axial_vector(A_lanes, a);
          symmetric_times(stretches.inverse, a, w);
          add_skew(w, W);
          Tensor<2, 3> skew;
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              skew[i][j] = W[i][j][0];
          largest =
            std::max(largest,
                     (R * skew - difference).norm() / difference.norm());
        }
      report(inverted ? "largest relative difference, inverted" :
                        "largest relative difference",
             largest);
      EXPECT_LE(largest, 1e-9);
    }
}

// Products with the skew matrix W(w) are compared with dense products.
TEST(RotationDerivative, SkewProducts)
{
  Random             random;
  const Tensor<2, 3> X = random.matrix(), A = random.matrix();
  const Tensor<2, 3> sigma = symmetrize(random.matrix());
  const Tensor<1, 3> w({0.3, -1.1, 0.7});
  Tensor<2, 3>       W;
  W[2][1] = w[0];
  W[1][2] = -w[0];
  W[0][2] = w[1];
  W[2][0] = -w[1];
  W[1][0] = w[2];
  W[0][1] = -w[2];
  Simd<double> X_lanes[3][3], A_lanes[3][3], sigma_lanes[3][3], w_lanes[3],
    left[3][3], right[3][3], moment[3] = {};
  for (unsigned int a = 0; a < 3; ++a)
    {
      w_lanes[a] = broadcast(w[a]);
      for (unsigned int b = 0; b < 3; ++b)
        {
          X_lanes[a][b]     = broadcast(X[a][b]);
          A_lanes[a][b]     = broadcast(A[a][b]);
          sigma_lanes[a][b] = broadcast(sigma[a][b]);
        }
    }
  skew_times(w_lanes, X_lanes, left);
  times_skew(X_lanes, w_lanes, right);
  add_moment(broadcast(2.), sigma_lanes, A_lanes, moment);
  double power = 0;
  for (unsigned int a = 0; a < 3; ++a)
    {
      power += w[a] * moment[a][0];
      for (unsigned int b = 0; b < 3; ++b)
        {
          EXPECT_NEAR(left[a][b][0], (W * X)[a][b], 1e-15);
          EXPECT_NEAR(right[a][b][0], (X * W)[a][b], 1e-15);
        }
    }
  EXPECT_NEAR(power, -2 * scalar_product(sigma, W * A), 1e-14);
}
