// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_with_tangent_h
#define corotet_operators_with_tangent_h

#include <corotet/discretization/with_degree.h>
#include <corotet/operators/tangent_sweep.h>

namespace corotet
{
  /// Calls function(p, rotation, tangent) with constants for the degree and one
  /// of the four linearizations that there are.
  template <typename Function>
  void
  with_tangent(const unsigned int degree,
               const Rotation     rotation,
               const Tangent      tangent,
               const Function    &function)
  {
    using std::integral_constant;
    constexpr integral_constant<Tangent, Tangent::frozen_rotation> frozen;
    constexpr integral_constant<Tangent, Tangent::consistent>      consistent;
    constexpr integral_constant<Rotation, Rotation::quadrature_points> points;
    with_degree(degree, [&](const auto p) {
      if (rotation == Rotation::quadrature_points)
        {
          if (tangent == Tangent::consistent)
            function(p, points, consistent);
          else
            function(p, points, frozen);
        }
      else if (rotation == Rotation::cell_centre)
        function(p,
                 integral_constant<Rotation, Rotation::cell_centre>(),
                 consistent);
      else
        function(
          p,
          integral_constant<Rotation, Rotation::cell_centre_variational>(),
          consistent);
    });
  }
} // namespace corotet

#endif
