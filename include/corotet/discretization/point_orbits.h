// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_point_orbits_h
#define corotet_discretization_point_orbits_h

#include <corotet/discretization/reference_element.h>

namespace corotet
{
  /// Sorts the points of a rule and their weights by orbits. Throws an
  /// ExcInternalError if the rule does not consist of orbits.
  std::vector<PointOrbit>
  sort_into_orbits(std::vector<dealii::Point<3>> &points,
                   std::vector<double>           &weights);

  /// Sets the factors of @p orbit for derivatives of polynomials of @p degree 2
  /// or 3; degree 1 needs none.
  void
  set_factors(PointOrbit &orbit, const unsigned int degree);
} // namespace corotet

#endif
