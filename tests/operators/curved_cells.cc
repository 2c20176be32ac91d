// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Operators on curved cells, in meshes with straight cells, too. Where a test
// says "exact", polynomials are integrated by rules of their degree.

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/laws/corotational.h>
#include <corotet/material/corotational.h>
#include <corotet/operators/effective_operator.h>
#include <corotet/operators/surface.h>

#include <gtest/gtest.h>

#include <random>

#include "../curved_mesh.h"
#include "random_states.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  std::string
  body_text(const Element element, const std::string &mass = "")
  {
    return element_text(element, mass) + material_text(1e3, 0.4, 2);
  }

  Vector
  random_vector(const MovingBody &body, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1, 1);
    const std::size_t   n_nodes = body.discretization.n_global_nodes();
    std::vector<double> numbers(3 * n_nodes);
    for (double &x : numbers)
      x = number(generator);
    Vector v;
    body.discretization.initialize_vector(v);
    for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        v.local_element(3 * n + a) =
          numbers[3 * body.discretization.global_node(n) + a];
    v.update_ghost_values();
    return v;
  }

  Vector
  owned(const Vector &v)
  {
    Vector result(v);
    result.zero_out_ghost_values();
    return result;
  }

  // The results of a law at a point.
  struct AtPoint
  {
    Tensor<2, 3> P;
    double       energy_density, von_mises;
  };

  // Linear and corotational elasticity by formulas with the given rotation R,
  // which the law itself has to compute; other laws by their own functions.
  AtPoint
  at_point(const NamedLaw          &named,
           const IsotropicMaterial &m,
           const Tensor<2, 3>      &H,
           const Tensor<2, 3>      &R)
  {
    const MaterialLaw &law = *named.law;
    if (law.is_linear() || named.name.starts_with("corotational"))
      {
        const SymmetricTensor<2, 3> strain = corotational_strain(H, R);
        return {corotational_stress(m, H, R),
                energy_density(m, strain),
                von_mises(stress(m, strain))};
      }
    SymmetricTensor<2, 3> sigma;
    law.spatial_stresses(m, H, {&H, 1}, &sigma);
    return {law.stress(m, H), law.energy_density(m, H), von_mises(sigma)};
  }
} // namespace

class CurvedCells : public testing::TestWithParam<Curved>
{
protected:
  MovingBody body{half_curved_box(GetParam().q), body_text(GetParam().element)};
};

// The mesh has both straight and curved cells.
TEST_P(CurvedCells, MeshIsMixed)
{
  unsigned int n = 0;
  for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
    n += body.discretization.is_curved(c) ? 1 : 0;
  EXPECT_EQ(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD), 40u);
  EXPECT_EQ(body.discretization.n_global_cells(), 80u);
}

// The space contains affine deformations F x. Their stress P is constant, so
// the internal force is that of tractions P n on the surface, zero inside, and
// the energy is the volume times a constant: all exact. A rigid motion has P =
// 0; the force is compared with that of a stretch.
TEST_P(CurvedCells, PatchTest)
{
  const auto        &reference = body.reference;
  const Tensor<2, 3> Q = rotation_about(Tensor<1, 3>({0.3, -1., 2.}), 1.1);
  Tensor<2, 3>       stretch({{1.2, 0.1, 0.}, {0.1, 0.9, 0.2}, {0., 0.2, 1.1}});
  Tensor<2, 3>       identity(dealii::unit_symmetric_tensor<3>());
  double             unit = 0;
  for (const NamedLaw &named : all_laws())
    for (const Tensor<2, 3> &S : {stretch, identity})
      {
        const Tensor<2, 3> R = named.law->is_linear() ? identity : Q, F = R * S;
        const Vector       u =
          body.interpolate([&](const Point<3> &x) { return F * x - x; });
        Elasticity   elastic = elasticity_of(body, named.law);
        const Vector f       = force(elastic, u);

        const IsotropicMaterial m     = elastic.material(0);
        const AtPoint           point = at_point(named, m, F - identity, R);
        Vector                  expected(f);
        expected = 0;
        for (const BoundaryFace &face : body.discretization.boundary_faces())
          for_each_surface_point(
            body.discretization,
            reference,
            face,
            nullptr,
            [&](const SurfacePoint &on_face) {
              const Tensor<1, 3> t = point.P * on_face.area;
              for (const unsigned int i : reference.face_nodes[face.face])
                for (unsigned int a = 0; a < 3; ++a)
                  expected.local_element(
                    3 * body.discretization.cell_nodes(face.cell)[i] + a) +=
                    t[a] *
                    reference.face_rules[face.face].values[on_face.index][i];
            });
        expected.compress(dealii::VectorOperation::add);
        unit = std::max(unit, expected.linfty_norm());
        EXPECT_GT(unit, 1);
        EXPECT_LE(largest_difference(f, expected), 1e-12 * unit) << named.name;

        const double volume =
          displaced_volume(body.discretization, reference, u) / determinant(F);
        const ElasticState state = elastic.state(u);
        EXPECT_NEAR(state.energy, volume * point.energy_density, 1e-12 * unit)
          << named.name;
        EXPECT_NEAR(state.min_det_F, determinant(F), 1e-12);
        const CellResults results = elastic.cell_results(u);
        for (unsigned int c = 0; c < results.det_F.size(); ++c)
          {
            EXPECT_NEAR(results.det_F[c], determinant(F), 1e-12);
            EXPECT_NEAR(results.von_mises[c], point.von_mises, 1e-12 * m.mu);
          }
      }
}

// Where the force has an energy it is its gradient, and the consistent tangent
// is the derivative of the force: central differences with errors of h^2 and of
// round-off over h. The tangent with frozen rotations is that of linear
// elasticity in the rotated frame, so symmetric.
TEST_P(CurvedCells, Derivatives)
{
  const double h = 1e-5;
  for (const auto &[name, text, law] : nonlinear_laws())
    {
      Elasticity   elastic = elasticity_of(body, law);
      const Vector v       = random_direction(body);
      Vector       u       = displacement(body, states[1], 1., 1);
      if (!has_state(elastic, u))
        u = moved(displacement(body, states[0], 0., 1),
                  -0.6,
                  displacement(body, states[0], 0., 1));
      ASSERT_TRUE(has_state(elastic, u));
      const Vector plus    = force(elastic, moved(u, h, v));
      const double E_plus  = elastic.state(moved(u, h, v)).energy;
      const Vector minus   = force(elastic, moved(u, -h, v));
      const double E_minus = elastic.state(moved(u, -h, v)).energy;
      const Vector f       = force(elastic, u);
      if (elastic.is_symmetric(Tangent::consistent))
        {
          EXPECT_NEAR((E_plus - E_minus) / (2 * h),
                      f * owned(v),
                      1e-9 * f.l2_norm() * owned(v).l2_norm())
            << name;
        }
      Vector difference(plus), Kv(plus);
      difference.add(-1., minus);
      difference *= 1 / (2 * h);
      elastic.linearize(u, Tangent::consistent);
      elastic.apply_linearization(Kv, v, 1., 0., nullptr, nullptr);
      EXPECT_LE(largest_difference(Kv, difference),
                1e-7 * difference.linfty_norm())
        << name;

      const Vector w = random_vector(body, 3);
      Vector       Kw(plus);
      if (!elastic.is_by_cell(Tangent::frozen_rotation))
        {
          elastic.linearize(u, Tangent::frozen_rotation);
          elastic.apply_linearization(Kv, v, 1., 0., nullptr, nullptr);
          elastic.apply_linearization(Kw, w, 1., 0., nullptr, nullptr);
        }
      else
        {
          elastic.apply_tangent(Kv, v);
          elastic.apply_tangent(Kw, w);
          Vector by_quadrature(Kv);
          elastic.apply_tangent_by_quadrature(by_quadrature, v);
          EXPECT_LE(largest_difference(by_quadrature, Kv),
                    1e-13 * Kv.linfty_norm());
        }
      EXPECT_NEAR(Kv * owned(w), Kw * owned(v), 1e-12 * std::abs(Kv * owned(v)))
        << name;
    }
}

// The operator A by kernels, as a matrix, and as the sum of stiffness and mass;
// also its diagonal.
TEST_P(CurvedCells, EffectiveOperator)
{
  Elasticity elastic =
    elasticity_of(body, corotational_law(Rotation::cell_centre));
  elastic.update_rotations(displacement(body, states[1], 1., 1));
  const std::vector<unsigned char> free(std::size_t(3) *
                                          body.discretization.n_local_nodes(),
                                        0);
  EffectiveOperator A(body.discretization, elastic, body.mass, free);
  const double      c_K = 0.7, c_M = 500;
  A.update(c_K, c_M);
  const Vector v = random_vector(body, 5);
  Vector       product(owned(v)), Kv(product), Mv(product);
  A.vmult(product, owned(v));
  elastic.apply_tangent(Kv, v);
  body.mass.apply(Mv, v);
  Kv *= c_K;
  Kv.add(c_M, Mv);
  EXPECT_LE(largest_difference(product, Kv), 1e-13 * Kv.linfty_norm());
  A.matrix().vmult(product, owned(v));
  EXPECT_LE(largest_difference(product, Kv), 1e-13 * Kv.linfty_norm());
  const double unit = A.diagonal().linfty_norm();
  for (unsigned int i = 0; i < product.locally_owned_size(); ++i)
    EXPECT_NEAR(A.diagonal().local_element(i),
                A.matrix().diagonal(i),
                1e-13 * unit);
}

// Coarser forms are Galerkin projections P^T A P, by kernels in double and
// single precision and as a matrix: they use the finest element's points.
TEST_P(CurvedCells, CoarserForms)
{
  const Element element = GetParam().element;
  Elasticity    elastic =
    elasticity_of(body, corotational_law(Rotation::cell_centre));
  elastic.update_rotations(displacement(body, states[1], 1., 1));
  const Mass        &mass = body.mass;
  const CoarserNodes coarser(body.discretization);
  // The mass is diagonal with bubbles, but not for coarser elements.
  const double c_M = element.has_bubbles() ? 0 : 500;

  CellwiseOperator<double> fine(body.discretization, {}), coarse(coarser, {});
  for (CellwiseOperator<double> *A : {&fine, &coarse})
    A->set_terms(1.,
                 elastic.coefficients().data(),
                 c_M,
                 mass.cell_masses().data(),
                 nullptr);
  Vector x, fine_x, fine_y, y, z;
  for (Vector *vector : {&x, &y, &z})
    coarser.initialize_vector(*vector);
  for (Vector *vector : {&fine_x, &fine_y})
    body.discretization.initialize_vector(*vector);
  for (unsigned int n = 0; n < coarser.n_owned_nodes(); ++n)
    for (unsigned int a = 0; a < 3; ++a)
      x.local_element(3 * n + a) =
        std::sin(7. * body.discretization.node_position(coarser.key(n))[a] + a);
  x.update_ghost_values();
  coarser.prolongate_add(fine_x, x);
  x.zero_out_ghost_values();
  fine.vmult(fine_y, fine_x);
  coarser.restrict_to(y, fine_y);
  coarse.vmult(z, x);
  EXPECT_LE(largest_difference(z, y), 1e-13 * y.linfty_norm());

  AssembledMatrix matrix(
    coarser,
    std::vector<unsigned char>(std::size_t(3) * coarser.n_local_nodes(), 0),
    block_pattern(coarser));
  matrix.update(1., elastic.coefficients(), c_M, mass.cell_masses(), nullptr);
  matrix.matrix().vmult(z, x);
  EXPECT_LE(largest_difference(z, y), 1e-13 * y.linfty_norm());
}

// The rows of the mass matrix sum to the integrals of the functions, which sum
// to the volume; a lumped mass has the same sum. All exact.
TEST_P(CurvedCells, Mass)
{
  const Element            element = GetParam().element;
  std::vector<std::string> types{"consistent", "diagonal scaling"};
  if (element.has_bubbles())
    types = {"nodal quadrature"};
  for (const std::string &type : types)
    {
      MovingBody body(half_curved_box(GetParam().q), body_text(element, type));
      const Vector one = body.interpolate(
        [](const Point<3> &) { return Tensor<1, 3>({1, 0, 0}); });
      Vector zero(one), f(owned(one));
      zero = 0;
      zero.update_ghost_values();
      const double volume =
        displaced_volume(body.discretization, body.reference, zero);
      double sum = 0;
      for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
        sum += body.discretization.geometry(c).volume;
      sum = dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
      EXPECT_NEAR(sum, volume, 1e-13);
      EXPECT_NEAR(body.discretization.volume(), volume, 1e-13);
      EXPECT_NEAR(body.mass.total(), 2 * volume, 1e-13);
      body.mass.apply(f, one);
      EXPECT_NEAR(f * owned(one), 2 * volume, 1e-12);
      for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
        EXPECT_GT(body.mass.diagonal().local_element(i), 0);
    }
}

// Straight cells that are described as curved give the same results, to
// round-off; with a rotation for each point only if they have the same points.
TEST_P(CurvedCells, StraightMaps)
{
  const Element    element  = GetParam().element;
  const SerialMesh straight = box("1, 2, 1", "2, 3, 2", 0.2);
  const SerialMesh mapped =
    curved(straight, GetParam().q, [](const Point<3> &x) { return x; });
  const std::string text =
    body_text(element) + section("Loads", {{"Body force", "x; 1; y * z"}}) +
    tractions("x-max: x; y; z") + pressures("y-max: x + z");
  MovingBody   a(straight, text), b(mapped, text);
  const Vector u = displacement(a, states[1], 1., 1), v = random_vector(a, 4);
  ASSERT_TRUE(b.discretization.is_curved(0));
  ASSERT_FALSE(a.discretization.is_curved(0));

  const auto compare = [](const Vector &x, const Vector &y) {
    EXPECT_LE(largest_difference(x, y), 2e-13 * x.linfty_norm());
  };
  for (const auto &[name, text, law] : all_laws())
    {
      Elasticity e = elasticity_of(a, law), d = elasticity_of(b, law);
      // The rule for curved cells has more points, so results differ where the
      // integrand is not a polynomial.
      if (!law->is_linear() && !law->has_cell_rotation() &&
          !element.has_bubbles())
        continue;
      compare(force(e, u), force(d, u));
      EXPECT_NEAR(e.state(u).energy,
                  d.state(u).energy,
                  1e-13 * e.state(u).energy);
      Vector x(owned(u)), y(x);
      e.apply_tangent(x, v);
      d.apply_tangent(y, v);
      compare(x, y);
      for (const Tangent tangent :
           {Tangent::frozen_rotation, Tangent::consistent})
        if (!e.is_by_cell(tangent))
          {
            e.linearize(u, tangent);
            d.linearize(u, tangent);
            const auto masses = [&](const MovingBody &body) {
              return element.has_bubbles() ? nullptr :
                                             body.mass.cell_masses().data();
            };
            e.apply_linearization(x, v, 1.3, 20., masses(a), nullptr);
            d.apply_linearization(y, v, 1.3, 20., masses(b), nullptr);
            compare(x, y);
          }
    }
  compare(a.mass.diagonal(), b.mass.diagonal());
  a.state.u.copy_locally_owned_data_from(u);
  b.state.u.copy_locally_owned_data_from(u);
  compare(a.system.equation().evaluate(a.state, 0., 1.).external,
          b.system.equation().evaluate(b.state, 0., 1.).external);
}

INSTANTIATE_TEST_SUITE_P(Elements,
                         CurvedCells,
                         testing::ValuesIn(curved_elements));
