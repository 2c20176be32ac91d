// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/neo_hookean.h>
#include <corotet/operators/law_sweeps.h>

#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    // F and the quantities that depend on it. Those that are small at small
    // strains, however the body is turned, are computed from C - I = H + H^T +
    // H^T H:
    //
    //   J^2 - 1 = I_1 + I_2 + I_3,
    //
    // the sum of its invariants, and so W = mu / 2 (x - ln(1 + x) - I_2 - I_3)
    // + lambda / 8 ln(1 + x)^2 with x = J^2 - 1.
    struct Kinematics
    {
      COROTET_ALWAYS_INLINE
      explicit Kinematics(const Tensor2Lanes &H)
      {
        transposed_times(H, H, C_minus_1);
        static_for<9>([&](auto ab) {
          constexpr int a = ab / 3, b = ab % 3;
          C_minus_1[a][b] += H[a][b] + H[b][a];
          F[a][b] = H[a][b] + (a == b ? 1. : 0.);
        });
        J = determinant(F);
        static_for<3>([&](auto row) {
          constexpr int a = row, b = (a + 1) % 3;
          second += C_minus_1[a][a] * C_minus_1[b][b] -
                    C_minus_1[a][b] * C_minus_1[b][a];
        });
        third = determinant(C_minus_1);
        trace = C_minus_1[0][0] + C_minus_1[1][1] + C_minus_1[2][2];
        x     = trace + second + third;
        for (int lane = 0; lane < n_lanes<double>; ++lane)
          take_logarithm(lane);
      }

      // F^-T: the cofactors of F over J.
      COROTET_ALWAYS_INLINE void
      inverse_transposed(Tensor2Lanes &G) const
      {
        static_for<9>([&](auto i) {
          constexpr int a = i / 3, b = i % 3;
          constexpr int a1 = (a + 1) % 3, a2 = (a + 2) % 3;
          constexpr int b1 = (b + 1) % 3, b2 = (b + 2) % 3;
          G[a][b] = (F[a1][b1] * F[a2][b2] - F[a1][b2] * F[a2][b1]) / J;
        });
      }

      Tensor2Lanes F, C_minus_1;
      Simd<double> J, trace, second{}, third, x;
      // ln J^2, not a number where J <= 0, and tr(C - I) - ln J^2.
      Simd<double> logarithm{}, excess{};

    private:
      static COROTET_ALWAYS_INLINE Simd<double>
                                   determinant(const Tensor2Lanes &A)
      {
        return A[0][0] * (A[1][1] * A[2][2] - A[1][2] * A[2][1]) +
               A[0][1] * (A[1][2] * A[2][0] - A[1][0] * A[2][2]) +
               A[0][2] * (A[1][0] * A[2][1] - A[1][1] * A[2][0]);
      }

      // For small x, ln(1 + x) = 2 artanh(y) with y = x / (2 + x): below 0.1
      // the first term left out is 1e-15 of the sum. For other x it is taken
      // from J, which in nearly flat cells has more digits than 1 + x.
      COROTET_ALWAYS_INLINE void
      take_logarithm(const int lane)
      {
        const double z = x[lane];
        if (std::abs(z) < 0.1)
          {
            const double y = z / (2 + z), s = y * y;
            const double sum =
              s *
              (1. / 3 + s * (1. / 5 + s * (1. / 7 + s * (1. / 9 + s / 11))));
            logarithm[lane] = 2 * y * (1 + sum);
            // x - ln(1 + x) - I_2 - I_3. At large strains these invariants have
            // more round-off than trace and logarithm.
            excess[lane] = std::abs(trace[lane]) < 0.1 ?
                             z * y - 2 * y * sum - second[lane] - third[lane] :
                             trace[lane] - logarithm[lane];
          }
        else
          {
            logarithm[lane] = 2 * std::log(J[lane]);
            excess[lane]    = trace[lane] - logarithm[lane];
          }
        if (!(J[lane] > 0))
          logarithm[lane] = std::numeric_limits<double>::quiet_NaN();
      }
    };

    struct NeoHookean
    {
      // The numbers stored are F^-T and mu - lambda ln J.
      static constexpr int n_stored = 10;

      // P = F^-T (mu (C - I) + lambda ln J I).
      COROTET_ALWAYS_INLINE void
      stress(const LameLanes    &lame,
             const Tensor2Lanes &H,
             Tensor2Lanes       &P) const
      {
        Kinematics   k(H);
        Tensor2Lanes G;
        k.inverse_transposed(G);
        static_for<9>([&](auto i) { k.C_minus_1[i / 3][i % 3] *= lame.mu; });
        static_for<3>([&](auto a) {
          k.C_minus_1[a][a] += 0.5 * lame.lambda * k.logarithm;
        });
        times(G, k.C_minus_1, P);
      }

      COROTET_ALWAYS_INLINE Simd<double>
      energy_density(const LameLanes &lame, const Tensor2Lanes &H) const
      {
        const Kinematics   k(H);
        const Simd<double> energy =
          0.5 * lame.mu * k.excess +
          0.125 * lame.lambda * k.logarithm * k.logarithm;
        return k.J > 0. ? energy :
                          broadcast(std::numeric_limits<double>::infinity());
      }

      COROTET_ALWAYS_INLINE unsigned int
      linearize(const LameLanes       &lame,
                const Tensor2Lanes    &H,
                NumberLanes<n_stored> &stored) const
      {
        const Kinematics k(H);
        Tensor2Lanes     G;
        k.inverse_transposed(G);
        static_for<9>([&](auto i) { stored[i] = G[i / 3][i % 3]; });
        stored[9] = lame.mu - 0.5 * lame.lambda * k.logarithm;
        return 0;
      }

      // dP = mu dF + (mu - lambda ln J) G dF^T G + lambda (G : dF) G with
      // G = F^-T.
      COROTET_ALWAYS_INLINE void
      derivative(const LameLanes             &lame,
                 const NumberLanes<n_stored> &stored,
                 const Tensor2Lanes          &dF,
                 Tensor2Lanes                &dP) const
      {
        Tensor2Lanes G, A;
        Simd<double> trace{};
        static_for<9>([&](auto i) {
          G[i / 3][i % 3] = stored[i];
          trace += stored[i] * dF[i / 3][i % 3];
        });
        transposed_times(dF, G, A);
        static_for<9>([&](auto i) { A[i / 3][i % 3] *= stored[9]; });
        static_for<3>([&](auto a) { A[a][a] += lame.lambda * trace; });
        times(G, A, dP);
        static_for<9>(
          [&](auto i) { dP[i / 3][i % 3] += lame.mu * dF[i / 3][i % 3]; });
      }
    };
  } // namespace

  std::shared_ptr<const MaterialLaw>
  neo_hookean_law()
  {
    return std::make_shared<MaterialLawOf<NeoHookean>>();
  }
} // namespace corotet
