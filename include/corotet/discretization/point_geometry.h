// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_point_geometry_h
#define corotet_discretization_point_geometry_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>

namespace corotet
{
  /**
   * The geometry of a cell at rest at a point of a rule.
   */
  struct PointGeometry
  {
    /// Rows are the gradients of the reference coordinates [1/m].
    dealii::Tensor<2, 3> inverse_jacobian;
    /// The point's share of the cell's volume [m^3].
    double volume;
  };

  PointGeometry
  point_geometry(const Discretization                &discretization,
                 const ReferenceElement::PointValues &rule,
                 const unsigned int                   cell,
                 const unsigned int                   q);

  /// The position of a point of a rule in a cell at rest [m].
  dealii::Point<3>
  point_position(const Discretization                &discretization,
                 const ReferenceElement::PointValues &rule,
                 const unsigned int                   cell,
                 const unsigned int                   q);

  /// The gradient grad u [component][direction] [-] at point @p q of a rule in
  /// a local cell. The ghost entries of @p u must be up to date. A translation
  /// does not reduce the accuracy.
  dealii::Tensor<2, 3>
  displacement_gradient(const Discretization                &discretization,
                        const Vector                        &u,
                        const unsigned int                   cell,
                        const ReferenceElement::PointValues &rule,
                        const unsigned int                   q);
} // namespace corotet

#endif
