// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/cell_centred.h>
#include <corotet/laws/corotational.h>
#include <corotet/material/quaternion_simd.h>
#include <corotet/operators/law_sweeps.h>

namespace corotet
{
  namespace
  {
    /**
     * Corotational elasticity with the rotation of each point, P = R sigma(S -
     * I) with F = R S [seed, 2.73 to 2.76]. Rotations are kept as quaternions,
     * as reading kept numbers limits the speed of the tangents.
     */
    struct CorotationalAtPoints
    {
      static constexpr int n_stored = 10;
      static constexpr int n_frozen = 4;

      COROTET_ALWAYS_INLINE PolarLanes
      stress(const LameLanes    &lame,
             const Tensor2Lanes &H,
             Tensor2Lanes       &P) const
      {
        Tensor2Lanes     F, R;
        const PolarLanes found = rotation(H, F, R);
        corotational_stress(R, lame.lambda, lame.mu, F, P);
        return found;
      }

      COROTET_ALWAYS_INLINE Simd<double>
      energy_density(const LameLanes &lame, const Tensor2Lanes &H) const
      {
        Tensor2Lanes F, R, e;
        rotation(H, F, R);
        corotational_strain(R, H, e);
        return isotropic_energy(lame.lambda, lame.mu, e);
      }

      /// Stores R, and T of rotation_stiffness().
      COROTET_ALWAYS_INLINE unsigned int
      linearize(const LameLanes       &lame,
                const Tensor2Lanes    &H,
                NumberLanes<n_stored> &stored) const
      {
        Tensor2Lanes F, R;
        Simd<double> S[6], T[6];
        rotation(H, F, R);
        stretch(R, F, S);
        const unsigned int clamped =
          rotation_stiffness(lame.lambda, lame.mu, S, T);
        keep(R, stored);
        static_for<6>([&](auto i) { stored[4 + i] = T[i]; });
        return clamped;
      }

      COROTET_ALWAYS_INLINE void
      derivative(const LameLanes             &lame,
                 const double                 frozen_factor,
                 const NumberLanes<n_stored> &stored,
                 const Tensor2Lanes          &dF,
                 Tensor2Lanes                &dP) const
      {
        Tensor2Lanes R, A, sigma;
        Simd<double> T[6], a[3], t[3];
        kept(stored, R);
        static_for<6>([&](auto i) { T[i] = stored[4 + i]; });
        transposed_times(R, dF, A);
        isotropic_stress(frozen_factor * lame.lambda,
                         frozen_factor * lame.mu,
                         A,
                         sigma);
        axial_vector(A, a);
        symmetric_times(T, a, t);
        add_skew(t, sigma);
        times(R, sigma, dP);
      }

      COROTET_ALWAYS_INLINE void
      linearize_frozen(const Tensor2Lanes    &H,
                       NumberLanes<n_frozen> &stored) const
      {
        Tensor2Lanes F, R;
        rotation(H, F, R);
        keep(R, stored);
      }

      COROTET_ALWAYS_INLINE void
      frozen_derivative(const LameLanes             &lame,
                        const NumberLanes<n_frozen> &stored,
                        const Tensor2Lanes          &dF,
                        Tensor2Lanes                &dP) const
      {
        Tensor2Lanes R;
        kept(stored, R);
        corotational_tangent(R, lame.lambda, lame.mu, dF, dP);
      }

      /// The stress R sigma R^T: sigma rotated back into space, which is
      /// Cauchy's stress up to terms of the order of the strain.
      COROTET_ALWAYS_INLINE void
      spatial_stress(const LameLanes    &lame,
                     const Tensor2Lanes &H,
                     Tensor2Lanes       &sigma) const
      {
        Tensor2Lanes F, R, e, inner, Rs;
        rotation(H, F, R);
        corotational_strain(R, H, e);
        isotropic_stress(lame.lambda, lame.mu, e, inner);
        times(R, inner, Rs);
        static_for<9>([&](auto ab) {
          constexpr int a = ab / 3, b = ab % 3;
          sigma[a][b] =
            Rs[a][0] * R[b][0] + Rs[a][1] * R[b][1] + Rs[a][2] * R[b][2];
        });
      }

    private:
      /// Computes F = I + H and its rotation.
      static COROTET_ALWAYS_INLINE PolarLanes
      rotation(const Tensor2Lanes &H, Tensor2Lanes &F, Tensor2Lanes &R)
      {
        internal::copy(H, F);
        add_identity(F);
        return polar_decomposition(F, R);
      }

      /// These store a rotation as the first four numbers, and restore it.
      template <int n>
      static COROTET_ALWAYS_INLINE void
      keep(const Tensor2Lanes &R, Simd<double> (&stored)[n])
      {
        Simd<double> q[4];
        to_quaternion(R, q);
        static_for<4>([&](auto i) { stored[i] = q[i]; });
      }

      template <int n>
      static COROTET_ALWAYS_INLINE void
      kept(const Simd<double> (&stored)[n], Tensor2Lanes &R)
      {
        Simd<double> q[4];
        static_for<4>([&](auto i) { q[i] = stored[i]; });
        to_rotation(q, R);
      }
    };
  } // namespace

  std::shared_ptr<const MaterialLaw>
  corotational_law(const Rotation rotation)
  {
    const auto at_points =
      std::make_shared<MaterialLawOf<CorotationalAtPoints>>();
    if (rotation == Rotation::quadrature_points)
      return at_points;
    return cell_centred_law(rotation == Rotation::cell_centre_variational,
                            at_points);
  }

  std::shared_ptr<const MaterialLaw>
  CorotationalKind::make(const Rotation rotation) const
  {
    return corotational_law(rotation);
  }
} // namespace corotet
