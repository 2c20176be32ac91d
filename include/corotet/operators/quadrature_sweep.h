// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_quadrature_sweep_h
#define corotet_operators_quadrature_sweep_h

#include <corotet/discretization/reference_element.h>
#include <corotet/operators/sweep.h>

#include <limits>

/**
 * Loops over batches of cells around the quadrature kernel: forces and energies
 * whose rotation is not that of the cell's centre alone. Their tangents are in
 * tangent_sweep.h.
 */
namespace corotet
{
  /// What a sweep over the points of the stiffness rule finds.
  struct PointResults
  {
    /// Elastic energy [J].
    double energy = 0;
    /// Smallest det F at these points and at the centres [-].
    double min_det_F = std::numeric_limits<double>::infinity();
    /// Cells where det F is negative at one of them, by more than round-off.
    unsigned int inverted_cells = 0;
  };

  using StateSweep = void (*)(const ReferenceElement &reference,
                              const ElasticData      &data,
                              const unsigned int      first,
                              const unsigned int      end,
                              const double           *displacement,
                              PointResults           &results);

  /// A sweep over the displacement that collects @p results. Rotations of cells
  /// are those that there are, rotations of points those of the displacement.
  StateSweep
  state_sweep(const Element element, const Rotation rotation);

  using PointForceSweep = void (*)(const ReferenceElement &reference,
                                   ElasticData            &data,
                                   const unsigned int      first,
                                   const unsigned int      end,
                                   const double           *displacement,
                                   double                 *sums);

  /// The internal force, in units of one, for Rotation::quadrature_points or
  /// cell_centre_variational, with rotations of its own: it neither reads nor
  /// changes those of the cells.
  PointForceSweep
  point_force_sweep(const Element element, const Rotation rotation);

  using QuadratureSweep = void (*)(const ReferenceElement &reference,
                                   const ElasticData      &data,
                                   const unsigned int      first,
                                   const unsigned int      end,
                                   const double           *source,
                                   double                 *sums);

  /// K source with the cells' rotations that there are, like form_sweep() but
  /// by quadrature and in units of one.
  QuadratureSweep
  tangent_by_quadrature_sweep(const Element element);
} // namespace corotet

#endif
