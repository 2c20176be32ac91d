// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_error_norms_h
#define corotet_operators_error_norms_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/material/isotropic.h>

#include <functional>
#include <map>

namespace corotet
{
  class VertexDilatation;

  /**
   * Norms of a displacement field v over the body at rest.
   */
  struct FieldNorms
  {
    /// sqrt(int |v|^2) [m^{5/2}].
    double L2 = 0;
    /// sqrt(int |grad v|^2), the seminorm [m^{3/2}].
    double H1 = 0;
    /// sqrt(int eps : C : eps) with eps = sym(grad v) [J^{1/2}]: the energy
    /// norm of linear elasticity, whatever the material's law. An error has the
    /// dilatation of vertices if error_norms() gets one.
    double energy = 0;
  };

  /**
   * Norms of the error of a displacement, and of the displacement that it is
   * measured against.
   */
  struct ErrorNorms
  {
    FieldNorms error;
    FieldNorms reference;
  };

  /// A displacement [m] and its gradient [component][direction] at a point.
  struct PointDisplacement
  {
    dealii::Tensor<1, 3> value;
    dealii::Tensor<2, 3> gradient;
  };

  /**
   * Norms of u - reference, by a rule that is exact for polynomials of degree
   * 9. Ghost entries of @p u must be up to date. Collective; @p reference is
   * called for points of the body at rest. @p dilatation is that of the
   * vertices for @p u; null if the law has the dilatation of cells.
   */
  ErrorNorms
  error_norms(
    const Discretization                            &discretization,
    const std::map<unsigned int, IsotropicMaterial> &materials,
    const Vector                                    &u,
    const std::function<PointDisplacement(const dealii::Point<3> &)> &reference,
    const VertexDilatation *dilatation = nullptr);
} // namespace corotet

#endif
