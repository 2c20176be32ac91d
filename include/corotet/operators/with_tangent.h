// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_with_tangent_h
#define corotet_operators_with_tangent_h

#include <corotet/operators/tangent_sweep.h>
#include <corotet/operators/with_kernel.h>

namespace corotet
{
  /// Calls function(kernel, rotation, tangent) with the type of the element's
  /// kernel and constants for one of the four linearizations that there are.
  template <typename Function>
  void
  with_tangent(const Element   element,
               const Rotation  rotation,
               const Tangent   tangent,
               const Function &function)
  {
    using std::integral_constant;
    constexpr integral_constant<Tangent, Tangent::frozen_rotation> frozen;
    constexpr integral_constant<Tangent, Tangent::consistent>      consistent;
    constexpr integral_constant<Rotation, Rotation::quadrature_points> points;
    with_kernel<double>(element, [&](const auto kernel) {
      if (rotation == Rotation::quadrature_points)
        {
          if (tangent == Tangent::consistent)
            function(kernel, points, consistent);
          else
            function(kernel, points, frozen);
        }
      else if (rotation == Rotation::cell_centre)
        function(kernel,
                 integral_constant<Rotation, Rotation::cell_centre>(),
                 consistent);
      else
        function(
          kernel,
          integral_constant<Rotation, Rotation::cell_centre_variational>(),
          consistent);
    });
  }
} // namespace corotet

#endif
