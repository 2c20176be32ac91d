// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_sweep_h
#define corotet_operators_sweep_h

#include <corotet/discretization/cell_batches.h>
#include <corotet/discretization/element.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/material/law.h>
#include <corotet/material/polar_decomposition_simd.h>
#include <corotet/operators/factored_kernel.h>

#include <bit>
#include <limits>

/**
 * Loops over batches of cells around the cell kernels: gather, compute, add.
 * They are compiled once for each element and number type, and know neither
 * vectors nor ranks; cell_loop.h does.
 */
namespace corotet
{
  /// Size and material of the cells of a batch. Zeros in lanes without a cell.
  struct alignas(sizeof(Simd<double>)) CellConstants
  {
    /// sqrt(mu volume) [J^{1/2}].
    double scale[batch_size];
    /// Volume [m^3].
    double volume[batch_size];
  };

  /// Geometry at rest of the cells of a batch. Zeros in lanes without a cell.
  struct alignas(sizeof(Simd<double>)) CellGeometryAtRest
  {
    /// Gradients of the reference coordinates, [3 (k - 1) + component] [1/m].
    double inverse_jacobian[9][batch_size];
  };

  /// One number for each cell of a batch.
  COROTET_ALWAYS_INLINE Simd<double>
                        lanes(const double *values)
  {
    return load_aligned<batch_size>(values);
  }

  /// The terms of a linear form.
  enum class Terms
  {
    stiffness,
    mass,
    stiffness_and_mass
  };

  /// The data that the sweep of a linear form reads.
  template <typename T>
  struct FormData
  {
    const CellBatches &batches;
    /// Null if there is no stiffness term.
    const CellCoefficients<T> *coefficients;
    /// Null if there is no mass term.
    const CellMasses<T> *masses;
    /// The factor of the masses.
    T mass_factor;
  };

  /**
   * Adds to @p sums the contributions of batches [first, end) of a chunk to K
   * source / stiffness_scale + mass_factor M source / mass_scale, or to one of
   * the terms. Source and sums have four numbers for each node of the chunk.
   */
  template <typename T>
  using FormSweep = void (*)(const FormData<T> &data,
                             const unsigned int first,
                             const unsigned int end,
                             const T           *source,
                             T                 *sums);

  /// The sweep for an element.
  template <typename T>
  FormSweep<T>
  form_sweep(const Element element, const Terms terms);

  /// A sweep for the diagonal of K + mass_factor M. It has no source.
  template <typename T>
  FormSweep<T>
  diagonal_sweep(const Element element, const Terms terms);

  /// The kernels' stiffness_scale and mass_scale.
  double
  stiffness_scale(const Element element);
  double
  mass_scale(const Element element);

  /// Numbers of cells of the last rotation update that needed care, at one of
  /// the points where rotations are taken.
  struct RotationCounts
  {
    /// Cells whose rotation needed the robust algorithm.
    unsigned int robust = 0;
    /// Cells with det F < 0.
    unsigned int inverted = 0;
    /// Cells that have collapsed to a plane, a line or a point.
    unsigned int degenerate = 0;

    /// Counts the cells of a batch.
    COROTET_ALWAYS_INLINE void
    add(const PolarLanes &lanes, const CellConstants &constants)
    {
      if (__builtin_expect(static_cast<long>(lanes.irregular != 0), 0))
        {
          unsigned int valid = 0;
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            valid |= (constants.scale[lane] > 0 ? 1u : 0u) << lane;
          robust += std::popcount(lanes.irregular & valid);
          inverted += std::popcount(lanes.inverted & valid);
          degenerate += std::popcount(lanes.degenerate & valid);
        }
    }
  };

  /// The results of a sweep over the points of the stiffness rule.
  struct PointResults
  {
    /// Elastic energy [J].
    double energy = 0;
    /// Smallest det F at these points and at the centres [-].
    double min_det_F = std::numeric_limits<double>::infinity();
    /// Cells where det F is negative at one of these points, by more than
    /// round-off.
    unsigned int inverted_cells = 0;
  };

  /// The data that the sweeps of elasticity read and write.
  struct ElasticData
  {
    const CellBatches              &batches;
    const ReferenceElement         &reference;
    const CellConstants            *constants;
    const CellCoefficients<double> *coefficients;
    /// Null if the cells have no rotations, R = I: then the coefficients have
    /// the gradients at rest.
    const CellGeometryAtRest *at_rest;
    /// The law, for sweeps that know its type.
    const void *law = nullptr;

    /// The coefficients, for sweeps that change rotations; null for others.
    CellCoefficients<double> *new_coefficients = nullptr;
    RotationCounts            counts           = {};
    PointResults              results          = {};

    /// Numbers that linearizations keep, for all batches: [number][lane] each.
    const double *linearization = nullptr;
    /// The same, for sweeps that linearize.
    double *new_linearization = nullptr;
    /// The displacement of the linearization, with ghosts, for sweeps that need
    /// it.
    const double *linearized_displacement = nullptr;
    /// Cells where a derivative was bounded.
    unsigned int n_clamped = 0;
    /// Factor of the part of the tangent with frozen rotations.
    double frozen_factor = 1;
    /// Null if the tangent has no mass term.
    const CellMasses<double> *masses      = nullptr;
    double                    mass_factor = 0;

    bool
    has_rotations() const
    {
      return at_rest != nullptr;
    }
  };

  /// Lamé's parameters of a batch [Pa], zeros in lanes without a cell.
  COROTET_ALWAYS_INLINE LameLanes
  lame(const ElasticData &data, const unsigned int batch)
  {
    const CellConstants &cells = data.constants[batch];
    const Simd<double>   scale = lanes(cells.scale);
    const Simd<double>   mu =
      scale * scale /
      (lanes(cells.volume) + std::numeric_limits<double>::min());
    return {lanes(data.coefficients[batch].lame_ratio) * mu, mu};
  }

  /**
   * The rotations of a batch, computed from the gradients at rest and rotated:
   * R = sum_k (R grad xi_k) (x) dx / dxi_k. So they need not be stored, which
   * saves time in rotation updates, as these are limited by memory bandwidth.
   */
  COROTET_ALWAYS_INLINE void
  rotations_of(const ElasticData &data,
               const unsigned int batch,
               Simd<double> (&R)[3][3])
  {
    using V = Simd<double>;
    if (!data.has_rotations())
      {
        static_for<9>(
          [&](auto i) { R[i / 3][i % 3] = broadcast(i % 4 == 0 ? 1. : 0.); });
        return;
      }
    V G[3][3], C[3][3];
    static_for<9>([&](auto i) {
      G[i / 3][i % 3] = lanes(data.at_rest[batch].inverse_jacobian[i]);
    });
    // dx / dxi_k is row k of the cofactors of G over det G.
    static_for<9>([&](auto i) {
      constexpr int k = i / 3, a = i % 3;
      constexpr int k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      constexpr int a1 = (a + 1) % 3, a2 = (a + 2) % 3;
      C[k][a] = G[k1][a1] * G[k2][a2] - G[k1][a2] * G[k2][a1];
    });
    const V det   = G[0][0] * C[0][0] + G[0][1] * C[0][1] + G[0][2] * C[0][2];
    const V scale = lanes(data.constants[batch].scale) * det;
    // Lanes without a cell have zeros throughout.
    const V factor = 1. / (scale > 0. ? scale : broadcast(1.));
    static_for<9>([&](auto i) {
      constexpr int a = i / 3, b = i % 3;
      V             sum{};
      static_for<3>([&](auto k) {
        sum += load_aligned<batch_size>(
                 data.coefficients[batch].gradients[3 * k + a]) *
               C[k][b];
      });
      R[a][b] = factor * sum;
    });
  }

  using ElasticSweep = void (*)(ElasticData       &data,
                                const unsigned int first,
                                const unsigned int end,
                                const double      *source,
                                double            *sums);

  /**
   * Sweeps over the displacement: for new rotations of the cells (also of ghost
   * cells; @p sums is not used), for the internal force of linear elasticity
   * with the present rotations, in units of stiffness_scale, or for both at
   * once.
   */
  ElasticSweep
  rotation_sweep(const Element element);
  ElasticSweep
  force_sweep(const Element element);
  ElasticSweep
  rotation_and_force_sweep(const Element element);

  /// Computes K source with the present rotations of the cells, like
  /// form_sweep(), but by quadrature and in units of one.
  ElasticSweep
  tangent_by_quadrature_sweep(const Element element);
} // namespace corotet

#endif
