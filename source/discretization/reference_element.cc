// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/finite_element.h>
#include <corotet/discretization/point_orbits.h>
#include <corotet/discretization/reference_element.h>
#include <corotet/discretization/with_degree.h>
#include <corotet/mesh/edges.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/reference_cell.h>

namespace corotet
{
  namespace
  {
    // The vertices of face f of the reference tetrahedron, counter-clockwise
    // seen from outside.
    std::array<dealii::Point<3>, 3>
    outward_face(const unsigned int f)
    {
      const dealii::ReferenceCell tetrahedron =
        dealii::ReferenceCells::Tetrahedron;
      std::array<dealii::Point<3>, 3> v;
      for (unsigned int i = 0; i < 3; ++i)
        v[i] = tetrahedron.face_vertex_location<3>(f, i);
      const dealii::Point<3>     centre(0.25, 0.25, 0.25);
      const dealii::Tensor<1, 3> normal =
        cross_product_3d(v[1] - v[0], v[2] - v[0]);
      if (normal * (centre - v[0]) > 0)
        std::swap(v[1], v[2]);
      return v;
    }
  } // namespace

  ReferenceElement::ReferenceElement(const Element element)
    : degree(element.degree())
    , n_nodes(element.n_nodes())
  {
    AssertThrow(degree >= 1 && degree <= 3, dealii::ExcInternalError());
    const auto &fe = finite_element(element);
    AssertDimension(fe.dofs_per_cell, n_nodes);

    // The stiffness rule is exact for degree 0, 2, 4, with 1, 4, 14 points.
    dealii::Quadrature<3> stiffness = dealii::QWitherdenVincentSimplex<3>(3);
    if (degree == 1)
      stiffness = dealii::QGaussSimplex<3>(1);
    else if (n_nodes == 10)
      stiffness = dealii::QWitherdenVincentSimplex<3>(1, false);
    // Rule n is exact for degree 2n-1. Loads need degree 2p = 2, 4, 6, with
    // bubbles 4 + 2.
    const unsigned int n = element.has_bubbles() ? 4 : degree + 1;
    const dealii::QWitherdenVincentSimplex<3> loads(n);
    stiffness_rule = tabulate_orbits(element, stiffness);
    load_rule      = tabulate(fe, loads.get_points(), loads.get_weights());
    centre         = tabulate(fe, {dealii::Point<3>(0.25, 0.25, 0.25)}, {1.});

    // Follower pressures need degree 3p-2 = 1, 4, 7, with bubbles 3 + 4 = 7.
    const dealii::QWitherdenVincentSimplex<2> on_face(n);
    for (unsigned int f = 0; f < 4; ++f)
      {
        const auto                    v = outward_face(f);
        std::vector<dealii::Point<3>> points;
        for (const dealii::Point<2> &p : on_face.get_points())
          points.push_back(v[0] + p[0] * (v[1] - v[0]) + p[1] * (v[2] - v[0]));
        face_rules[f]    = tabulate(fe, points, on_face.get_weights());
        face_tangents[f] = {{v[1] - v[0], v[2] - v[0]}};
        const dealii::Tensor<1, 3> normal =
          cross_product_3d(face_tangents[f][0], face_tangents[f][1]);
        for (unsigned int i = 0; i < n_nodes; ++i)
          if (std::abs(normal * (fe.unit_support_point(i) - v[0])) < 1e-10)
            face_nodes[f].push_back(i);
      }

    for (unsigned int e = 0; e < 6; ++e)
      for (unsigned int i = 0; i < n_nodes; ++i)
        {
          // On the edge, the barycentric coordinates of its ends sum to one;
          // elsewhere their sum is less.
          const dealii::Point<3> x = fe.unit_support_point(i);
          const double b[4]        = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
          if (b[ends_of_edges[e][0]] + b[ends_of_edges[e][1]] > 1 - 1e-10)
            edge_nodes[e].push_back(i);
        }

    // Products of shape functions have degree 2p, with bubbles 8.
    const dealii::QWitherdenVincentSimplex<3> products(
      element.has_bubbles() ? 5 : degree + 1);
    integrate_products(
      tabulate(fe, products.get_points(), products.get_weights()));
  }

  const ReferenceElement &
  ReferenceElement::of(const Element element)
  {
    if (element.has_bubbles())
      {
        static const ReferenceElement with_bubbles(element);
        return with_bubbles;
      }
    const ReferenceElement *result = nullptr;
    with_degree(element.degree(), [&](const auto p) {
      static const ReferenceElement of_degree{Element(p)};
      result = &of_degree;
    });
    AssertThrow(result != nullptr, dealii::ExcInternalError());
    return *result;
  }

  ReferenceElement::PointValues
  ReferenceElement::tabulate(const Element                        element,
                             const std::vector<dealii::Point<3>> &points,
                             const std::vector<double>           &weights)
  {
    return tabulate(finite_element(element), points, weights);
  }

  ReferenceElement::PointValues
  ReferenceElement::tabulate(const dealii::FiniteElement<3, 3>   &fe,
                             const std::vector<dealii::Point<3>> &points,
                             const std::vector<double>           &weights)
  {
    AssertThrow(!points.empty(),
                dealii::ExcMessage("The quadrature rule has no points."));
    const unsigned int            n = fe.dofs_per_cell;
    ReferenceElement::PointValues result;
    result.points  = points;
    result.weights = weights;
    double sum     = 0;
    for (const double w : weights)
      sum += w;
    for (double &w : result.weights)
      w /= sum;
    result.values.reinit(points.size(), n);
    result.gradients.reinit(points.size(), n, 3);
    for (unsigned int q = 0; q < points.size(); ++q)
      for (unsigned int i = 0; i < n; ++i)
        {
          result.values[q][i]                 = fe.shape_value(i, points[q]);
          const dealii::Tensor<1, 3> gradient = fe.shape_grad(i, points[q]);
          for (unsigned int k = 0; k < 3; ++k)
            result.gradients[q][i][k] = gradient[k];
        }
    return result;
  }

  ReferenceElement::PointValues
  ReferenceElement::curved_rule(const Element element)
  {
    // Rule n is exact for degree 2n, or 2n-1 if so chosen.
    const dealii::QWitherdenVincentSimplex<3> rule(
      element.has_bubbles() ? 3 : element.degree(), element.has_bubbles());
    return tabulate_orbits(element, rule);
  }

  ReferenceElement::PointValues
  ReferenceElement::tabulate_orbits(const Element                element,
                                    const dealii::Quadrature<3> &rule)
  {
    std::vector<dealii::Point<3>> points  = rule.get_points();
    std::vector<double>           weights = rule.get_weights();
    AssertThrow(points.size() <= max_stiffness_points(element.n_nodes()),
                dealii::ExcInternalError());
    std::vector<PointOrbit> orbits = sort_into_orbits(points, weights);
    PointValues             result = tabulate(element, points, weights);
    if (element.degree() > 1 && !element.has_bubbles())
      {
        unsigned int q = 0;
        for (PointOrbit &orbit : orbits)
          {
            orbit.weight = result.weights[q];
            set_factors(orbit, element.degree());
            q += orbit.n_points();
          }
        result.orbits = std::move(orbits);
      }
    return result;
  }

  void
  ReferenceElement::integrate_products(const PointValues &mass_rule)
  {
    mass.reinit(n_nodes, n_nodes);
    gradient_products.reinit(n_nodes, n_nodes, 9);
    for (unsigned int i = 0; i < n_nodes; ++i)
      for (unsigned int j = 0; j < n_nodes; ++j)
        {
          for (unsigned int q = 0; q < mass_rule.weights.size(); ++q)
            mass[i][j] += mass_rule.weights[q] * mass_rule.values[q][i] *
                          mass_rule.values[q][j];
          for (unsigned int q = 0; q < stiffness_rule.weights.size(); ++q)
            for (unsigned int k = 0; k < 3; ++k)
              for (unsigned int l = 0; l < 3; ++l)
                gradient_products[i][j][3 * k + l] +=
                  stiffness_rule.weights[q] *
                  stiffness_rule.gradients[q][i][k] *
                  stiffness_rule.gradients[q][j][l];
        }
  }
} // namespace corotet
