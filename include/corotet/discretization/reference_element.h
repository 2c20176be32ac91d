// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_discretization_reference_element_h
#define corotet_discretization_reference_element_h

#include <corotet/discretization/element.h>

#include <deal.II/base/point.h>
#include <deal.II/base/table.h>

#include <array>
#include <vector>

namespace dealii
{
  template <int dim, int spacedim>
  class FiniteElement;
  template <int dim>
  class Quadrature;
} // namespace dealii

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

  /**
   * Everything about an element on the reference tetrahedron that cell and
   * face integrals need, computed once: after set-up nothing asks a finite
   * element again. Weights are fractions of the cell's (face's) measure: they
   * sum to 1.
   */
  class ReferenceElement
  {
  public:
    /// Shape values and gradients at points of the reference tetrahedron.
    struct PointValues
    {
      std::vector<double>           weights;
      std::vector<dealii::Point<3>> points;
      /// [point][node]
      dealii::Table<2, double> values;
      /// [point][node][k]: derivative by the reference coordinate xi_k.
      dealii::Table<3, double> gradients;
      /// What the points consist of, in their order, with factors for
      /// derivatives. Only of the rules for stiffness of degrees 2 and 3.
      std::vector<PointOrbit> orbits;
    };

    /// The most points that rules for stiffness, of straight and of curved
    /// cells, have for an element of @p n_nodes nodes: kernels keep the values
    /// at all of them.
    static constexpr unsigned int
    max_stiffness_points(const unsigned int n_nodes)
    {
      return n_nodes == 4 ? 4 : n_nodes == 20 ? 24 : 14;
    }

    explicit ReferenceElement(const Element element);

    /// One that is made once, and lives as long as the program.
    static const ReferenceElement &
    of(const Element element);

    /// The functions of @p element at some points. Weights are scaled.
    static PointValues
    tabulate(const Element                        element,
             const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &weights);

    /// The same of a scalar element that is there already: making one takes
    /// longer than a point.
    static PointValues
    tabulate(const dealii::FiniteElement<3, 3>   &fe,
             const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &weights);

    /**
     * For stiffness and mass of curved cells with maps of at most the element's
     * degree p: of degree 2p; 4, 14, 24 points; with bubbles of degree 5, 14
     * points. So, with q <= p for the degree of the map,
     * - volumes are exact, of degree 3(q-1), and so are forces of constant
     *   stresses, of degree p-1 + 2(q-1);
     * - what full order takes, degree 2(p-1), is there;
     * - the mass matrix is definite: it is a product of functions that, on a
     *   straight cell, would be exact.
     */
    static PointValues
    curved_rule(const Element element);

    unsigned int degree;
    unsigned int n_nodes;

    /// Exact for products of two gradients, of degree 2(p-1): 1, 4, 14 points.
    /// With bubbles of degree 5, 14 points: all that full order takes.
    PointValues stiffness_rule;
    /// For loads that are given as expressions; exact for the element's
    /// functions times polynomials of degree p.
    PointValues load_rule;
    /// The barycentre, weight 1.
    PointValues centre;
    /// For each face, exact for a follower pressure: degree 3p-2, 7 with
    /// bubbles.
    std::array<PointValues, 4> face_rules;
    /**
     * Derivatives of xi by the two parameters of each face, ordered such that
     * their cross product in a positive cell points outwards with the length
     * of twice the face's area.
     */
    std::array<std::array<dealii::Tensor<1, 3>, 2>, 4> face_tangents;
    /// Nodes on each face.
    std::array<std::vector<unsigned int>, 4> face_nodes;
    /// Nodes on each edge, as ends_of_edges numbers them.
    std::array<std::vector<unsigned int>, 6> edge_nodes;

    /// Mean of N_i N_j over the cell: the mass matrix of a unit mass.
    dealii::Table<2, double> mass;
    /// [i][j][3 k + l]: mean of d_k N_i d_l N_j over the cell, by the stiffness
    /// rule.
    dealii::Table<3, double> gradient_products;

  private:
    /// A rule for stiffness, its points in the order of orbits.
    static PointValues
    tabulate_orbits(const Element element, const dealii::Quadrature<3> &rule);

    void
    integrate_products(const PointValues &mass_rule);
  };
} // namespace corotet

#endif
