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
   * Points of a tetrahedron that permutations of its vertices exchange.
   * Symmetric quadrature rules consist of such orbits, and values at the points
   * of an orbit have most of their sums in common (operators/orbit_form.h).
   */
  struct PointOrbit
  {
    /// The number of points, and which barycentric coordinates they have.
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

    /// The largest number of factors that values need.
    static constexpr unsigned int n_factors = 7;

    Kind                  kind;
    std::array<double, 3> coordinates;
    /// The weight of each point, as in PointValues::weights.
    double weight = 0;
    /// Factors of sums of coefficients, see orbit_form.h; and the same times
    /// the weight.
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
   * All data of an element on the reference tetrahedron that cell and face
   * integrals need, computed once: after set-up no finite element is evaluated.
   * Weights are fractions of the cell's (face's) measure: they sum to 1.
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
      /// The orbits that the points consist of, in their order, with factors
      /// for derivatives. Only for stiffness rules of degrees 2 and 3.
      std::vector<PointOrbit> orbits;
    };

    /// The largest number of points in stiffness rules, of straight and of
    /// curved cells, for an element of @p n_nodes nodes: kernels keep the
    /// values at all of them.
    static constexpr unsigned int
    max_stiffness_points(const unsigned int n_nodes)
    {
      return n_nodes == 4 ? 4 : n_nodes == 20 ? 24 : 14;
    }

    explicit ReferenceElement(const Element element);

    /// The reference element, made at the first call; it lives as long as the
    /// program.
    static const ReferenceElement &
    of(const Element element);

    /// The shape functions of @p element at some points. Weights are scaled.
    static PointValues
    tabulate(const Element                        element,
             const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &weights);

    /// The same for a scalar element that exists already: making one takes
    /// longer than evaluating a point.
    static PointValues
    tabulate(const dealii::FiniteElement<3, 3>   &fe,
             const std::vector<dealii::Point<3>> &points,
             const std::vector<double>           &weights);

    /**
     * The rule for stiffness and mass of curved cells with maps of at most the
     * element's degree p. Its degree is 2p, with 4, 14, 24 points; with bubbles
     * it is 5, with 14 points. So, with the degree q <= p of the map,
     * - volumes are exact, of degree 3(q-1), and so are forces of constant
     *   stresses, of degree p-1 + 2(q-1);
     * - degree 2(p-1), which full order needs, is integrated exactly;
     * - the mass matrix is definite: it is a product of functions that, on a
     *   straight cell, would be exact.
     */
    static PointValues
    curved_rule(const Element element);

    unsigned int degree;
    unsigned int n_nodes;

    /// The rule for stiffness of straight cells. It is exact for products of
    /// two gradients, of degree 2(p-1), with 1, 4, 14 points. With bubbles its
    /// degree is 5, which full order needs, with 14 points.
    PointValues stiffness_rule;
    /// The rule for loads that are given as expressions; exact for the
    /// element's functions times polynomials of degree p.
    PointValues load_rule;
    /// The barycentre, weight 1.
    PointValues centre;
    /// The rule of each face, exact for a follower pressure: degree 3p-2, with
    /// bubbles 7.
    std::array<PointValues, 4> face_rules;
    /**
     * Derivatives of xi by the two parameters of each face, ordered such that
     * their cross product in a positive cell points outwards with the length
     * of twice the face's area.
     */
    std::array<std::array<dealii::Tensor<1, 3>, 2>, 4> face_tangents;
    /// The nodes on each face.
    std::array<std::vector<unsigned int>, 4> face_nodes;
    /// The nodes on each edge, as ends_of_edges numbers them.
    std::array<std::vector<unsigned int>, 6> edge_nodes;

    /// The mean of N_i N_j over the cell: the mass matrix of a unit mass.
    dealii::Table<2, double> mass;
    /// [i][j][3 k + l]: the mean of d_k N_i d_l N_j over the cell, by the
    /// stiffness rule.
    dealii::Table<3, double> gradient_products;

  private:
    /// A stiffness rule with its points in the order of orbits.
    static PointValues
    tabulate_orbits(const Element element, const dealii::Quadrature<3> &rule);

    void
    integrate_products(const PointValues &mass_rule);
  };
} // namespace corotet

#endif
