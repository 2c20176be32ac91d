// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_surface_h
#define corotet_operators_surface_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/reference_element.h>

#include <array>

namespace corotet
{
  /**
   * A quadrature point on the surface of the body.
   */
  struct SurfacePoint
  {
    /// Index of the point in the face's rule.
    unsigned int     index;
    dealii::Point<3> at_rest;
    dealii::Point<3> position;
    /// Derivatives of the position by the face's two parameters [m].
    std::array<dealii::Tensor<1, 3>, 2> tangents;
    /// Outward normal times the point's share of the area [m^2].
    dealii::Tensor<1, 3> area;
  };

  /// Derivatives of node @p i's shape function by the two parameters of a face,
  /// at point @p q of the face's rule.
  inline std::array<double, 2>
  face_derivatives(const ReferenceElement &reference,
                   const unsigned int      face,
                   const unsigned int      q,
                   const unsigned int      i)
  {
    const double         *dN = &reference.face_rules[face].gradients(q, i, 0);
    std::array<double, 2> result{};
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int a = 0; a < 3; ++a)
        result[k] += dN[a] * reference.face_tangents[face][k][a];
    return result;
  }

  /**
   * Calls @p function(SurfacePoint) for the quadrature points of @p face, on
   * the body displaced by @p u (ghosts up to date), or at rest if @p u is null.
   * The area vectors of a displaced face are exact polynomials, and those of a
   * closed surface sum up to zero.
   */
  template <typename Function>
  void
  for_each_surface_point(const Discretization   &discretization,
                         const ReferenceElement &reference,
                         const BoundaryFace     &face,
                         const Vector           *u,
                         const Function         &function)
  {
    const auto &rule         = reference.face_rules[face.face];
    const auto  nodes        = discretization.cell_nodes(face.cell);
    const auto  displacement = [u](const unsigned int node) {
      dealii::Tensor<1, 3> result;
      if (u != nullptr)
        for (unsigned int a = 0; a < 3; ++a)
          result[a] = u->local_element(3 * node + a);
      return result;
    };
    const auto             first   = nodes[reference.face_nodes[face.face][0]];
    const dealii::Point<3> X_0     = discretization.node_position(first);
    const dealii::Tensor<1, 3> u_0 = displacement(first);
    for (unsigned int q = 0; q < rule.weights.size(); ++q)
      {
        SurfacePoint point{q, {}, {}, {}, {}};
        auto        &t = point.tangents;
        for (const unsigned int i : reference.face_nodes[face.face])
          {
            const dealii::Point<3> X = discretization.node_position(nodes[i]);
            const dealii::Tensor<1, 3> u_i = displacement(nodes[i]);
            point.at_rest += rule.values[q][i] * X;
            point.position += rule.values[q][i] * (X + u_i);
            // Tangents come from differences, as positions far away from the
            // origin are rounded coarsely.
            const dealii::Tensor<1, 3> side = (X - X_0) + (u_i - u_0);
            const auto dN = face_derivatives(reference, face.face, q, i);
            for (unsigned int k = 0; k < 2; ++k)
              t[k] += dN[k] * side;
          }
        point.area = cross_product_3d(t[0], t[1]) * (0.5 * rule.weights[q]);
        function(point);
      }
  }

  /**
   * The contribution of this rank's faces to the volume of the body displaced
   * by @p u [m^3], by the divergence theorem: the sum over all ranks is exact.
   */
  double
  local_displaced_volume(const Discretization   &discretization,
                         const ReferenceElement &reference,
                         const Vector           &u);

  /// The volume of the displaced body [m^3]. Collective.
  double
  displaced_volume(const Discretization   &discretization,
                   const ReferenceElement &reference,
                   const Vector           &u);
} // namespace corotet

#endif
