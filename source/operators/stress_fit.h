// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_operators_stress_fit_h
#define corotet_source_operators_stress_fit_h

#include <corotet/operators/stress_patches.h>

#include <array>

#include "monomials.h"

namespace corotet
{
  /// Six polynomials, one for each component of a stress: the coefficients of
  /// each monomial.
  template <int degree>
  using StressPolynomials =
    std::array<std::array<double, 6>, monomials::n_coefficients(degree)>;

  /// The monomials of a fit at a point.
  template <int degree>
  monomials::Values<degree>
  monomials_of(const StressFit &fit, const dealii::Point<3> &x)
  {
    return monomials::at<degree>(fit.scale * (x - fit.centre));
  }

  /// The largest number of samples in a cell.
  inline constexpr unsigned int max_samples =
    ReferenceElement::max_stiffness_points(20);

  /**
   * Calls action(number of the first sample, positions, monomials, weights) for
   * the samples of each cell of a fit.
   */
  template <int degree, typename Action>
  void
  for_each_cell_of(const StressFit     &fit,
                   const StressSamples &samples,
                   const Action        &action)
  {
    std::array<monomials::Values<degree>, max_samples> values;
    std::array<double, max_samples>                    weights;
    for (const unsigned int c : fit.cells)
      {
        const auto points = samples.points(c);
        AssertIndexRange(points.size(), max_samples + 1);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            values[q]  = monomials_of<degree>(fit, points[q]);
            weights[q] = fit.weight(points[q]);
          }
        action(samples.first_point(c), points, values, weights);
      }
  }
} // namespace corotet

#endif
