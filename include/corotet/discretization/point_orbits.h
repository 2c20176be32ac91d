// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_point_orbits_h
#define corotet_discretization_point_orbits_h

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace corotet
{
  /**
   * Points of a tetrahedron that permutations of its vertices exchange. Rules
   * of quadrature that favour no vertex consist of such orbits, and values at
   * their points have most of their sums in common (operators/orbit_form.h).
   */
  struct PointOrbit
  {
    /// The points, and which barycentric coordinates they have.
    enum class Kind
    {
      /// One point.
      centre,
      /// Four points: point i has coordinates[0] at vertex i, coordinates[1] at
      /// the others.
      vertices,
      /// Six points: point e has coordinates[0] at the ends of edge e of
      /// tetrahedron::edges, coordinates[1] at the others.
      edges,
      /// Twelve points: those of edge e have coordinates[0] at one of its ends,
      /// coordinates[1] at the other, coordinates[2] elsewhere; point 2 e has
      /// the first at the edge's first end.
      directed_edges
    };

    /// The most numbers that values need.
    static constexpr unsigned int n_factors = 7;

    Kind                  kind;
    std::array<double, 3> coordinates;
    /// Of each point, as PointValues::weights.
    double weight = 0;
    /// Numbers that multiply sums of coefficients, see orbit_form.h; and those
    /// times the weight.
    std::array<double, n_factors> factors          = {};
    std::array<double, n_factors> weighted_factors = {};

    unsigned int
    n_points() const
    {
      constexpr unsigned int n[4] = {1, 4, 6, 12};
      return n[static_cast<int>(kind)];
    }
  };

  /// Puts the points of a rule, and their weights, into the order of orbits.
  /// Throws an ExcInternalError if it does not consist of orbits.
  std::vector<PointOrbit>
  sort_into_orbits(std::vector<dealii::Point<3>> &points,
                   std::vector<double>           &weights);

  /// Sets the factors of @p orbit for derivatives of polynomials of @p degree 2
  /// or 3; those of degree 1 need none.
  void
  set_factors(PointOrbit &orbit, const unsigned int degree);
} // namespace corotet

#endif
