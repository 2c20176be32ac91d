// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Forces, energies and matrices of springs and dashpots, on all elements.

#include <corotet/base/exceptions.h>
#include <corotet/discretization/coarser_nodes.h>
#include <corotet/operators/surface_matrix.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "../curved_mesh.h"
#include "../refusal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;
using dealii::numbers::PI;

namespace
{
  const std::vector<Element> all_elements = {1,
                                             2,
                                             3,
                                             Element::quadratic_with_bubbles()};

  // A block of 2 m x 1 m x 1 m, of distorted cells.
  struct Block : public MovingBody
  {
    Block(const Element element, const std::string &text)
      : MovingBody(box("2, 1, 1", "3, 2, 2", 0.1), element_text(element) + text)
    {}
  };

  Vector
  translation(const MovingBody &body, const Tensor<1, 3> &u)
  {
    return body.interpolate([&](const Point<3> &) { return u; });
  }

  // The matrix of c_u times the springs plus c_v times the dashpots.
  SurfaceMatrix
  surface_matrix(const MovingBody &body, const double c_u, const double c_v)
  {
    SurfaceMatrix matrix(body.discretization, body.reference);
    auto         &equation = body.system.equation();
    equation.terms.surface_matrix(matrix, equation.motion(0.), c_u, c_v);
    return matrix;
  }

  // Sum of the forces on all nodes.
  Tensor<1, 3>
  total(const Vector &f)
  {
    Tensor<1, 3> sum;
    for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
      sum[i % 3] += f.local_element(i);
    return dealii::Utilities::MPI::sum(sum, f.get_mpi_communicator());
  }

  // The forces of springs whose stiffness does not depend on time.
  Vector
  force(MovingBody &body, const Vector &u)
  {
    Vector f;
    body.discretization.initialize_vector(f);
    body.system.equation().terms.elastic_force(f, {0., u, u});
    f *= -1;
    return f;
  }

  // A displacement that is not a polynomial of the elements.
  Tensor<1, 3>
  wavy(const Point<3> &x)
  {
    return Tensor<1, 3>({std::sin(3 * x[0] + x[1]),
                         std::cos(2 * x[1] - x[2]),
                         std::sin(x[0] * x[1] + 2 * x[2])});
  }

  // An eighth of a sphere of radius 1 with a hole of radius 1/2 and faces of
  // degree q; the boundary z-max is the sphere.
  SerialMesh
  thick_shell(const unsigned int n, const unsigned int q)
  {
    const std::string cells = std::to_string(n);
    return curved(box("1, 1, 1", cells + ", " + cells + ", 1"),
                  q,
                  [](const Point<3> &x) {
                    const double phi   = PI / 2 * x[0];
                    const double theta = PI / 2 - (PI / 2 - 0.3) * x[1];
                    const double r     = 0.5 + 0.5 * x[2];
                    return Point<3>(r * std::sin(theta) * std::cos(phi),
                                    r * std::sin(theta) * std::sin(phi),
                                    r * std::cos(theta));
                  });
  }
} // namespace

class ElasticSupportTest : public testing::TestWithParam<Element>
{};

INSTANTIATE_TEST_SUITE_P(Elements,
                         ElasticSupportTest,
                         testing::ValuesIn(all_elements));

// Under a translation u, the force on the side z = 0 of 2 m^2 is -u int k. The
// rule is exact for k linear in x: k_x = 1 + 2 x + 3 y has the integral 2 + 4 +
// 3 N/m; k_y = 5 everywhere.
TEST_P(ElasticSupportTest, ForceOfATranslation)
{
  Block        body(GetParam(), supports("z-min: 1 + 2 * x + 3 * y; 5; 0"));
  const Vector u       = translation(body, Tensor<1, 3>({2, 3, 4}));
  const Tensor<1, 3> f = total(force(body, u));
  EXPECT_NEAR(f[0], -2 * 9., 1e-13 * 18);
  EXPECT_NEAR(f[1], -3 * 10., 1e-13 * 30);
  EXPECT_EQ(f[2], 0);
  EXPECT_NEAR(body.system.equation().terms.energy({0., u, u}),
              0.5 * (4 * 9. + 9 * 10.),
              1e-13 * 63);
}

// Springs along the normal resist only the motion along it.
TEST_P(ElasticSupportTest, NormalSpringsOnAPlane)
{
  Block              body(GetParam(), supports("", "z-min: 7, x-max: 3"));
  const Vector       u = translation(body, Tensor<1, 3>({2, 3, 4}));
  const Tensor<1, 3> f = total(force(body, u));
  EXPECT_NEAR(f[0], -2 * 3., 1e-13 * 6);
  EXPECT_NEAR(f[1], 0, 1e-13 * 6);
  EXPECT_NEAR(f[2], -4 * 14., 1e-13 * 56);
}

// The force is minus the derivative of the energy, and the matrix minus that of
// the force: exactly, as the energy is quadratic, to the round-off of some ten
// terms.
TEST_P(ElasticSupportTest, Derivatives)
{
  Block             body(GetParam(),
             supports("z-min: 1 + x * x; 5 + y; 2", "x-max: 2 + z, y-min: 3"));
  const ForceTerms &terms = body.system.equation().terms;
  const Vector      u     = body.interpolate(wavy);
  const Vector      w     = body.interpolate(
    [](const Point<3> &x) { return wavy(Point<3>(x[2], x[0], x[1])); });
  Vector sum(u), difference(u);
  sum.zero_out_ghost_values();
  difference.zero_out_ghost_values();
  sum += w;
  difference -= w;
  sum.update_ghost_values();
  difference.update_ghost_values();
  Vector       f      = force(body, u);
  const double energy = terms.energy({0., u, u});
  EXPECT_NEAR(0.5 * (terms.energy({0., sum, sum}) -
                     terms.energy({0., difference, difference})),
              -(f * w),
              1e-13 * energy);
  EXPECT_NEAR(energy, -0.5 * (f * u), 1e-13 * energy);

  SurfaceOperator<double> S(body.discretization);
  S.set(surface_matrix(body, 2., 5.));
  f *= 2;
  S.add(f, u);
  EXPECT_LT(norm(f), 1e-13 * S.energy(u));
  EXPECT_FALSE(terms.has_surface_damping());
}

// A with springs is A without them plus S, matrix-free and assembled; its
// diagonal includes that of S; prescribed unknowns have no springs.
TEST_P(ElasticSupportTest, MatricesAgree)
{
  Block body(GetParam(),
             supports("z-min: 1e6; 2e6; 3e6", "x-max: 1e6") + fixed("x-min"));
  body.system.equation().evaluate(body.state, 0., 1.);
  const SurfaceMatrix matrix     = surface_matrix(body, 1., 0.);
  const auto         &prescribed = body.motion.is_prescribed();
  EffectiveOperator   A(
    body.discretization, body.elasticity, body.mass, prescribed, &matrix);
  EffectiveOperator without(body.discretization,
                            body.elasticity,
                            body.mass,
                            prescribed);
  A.update(2., 3.);
  without.update(2., 3.);
  Vector u = body.interpolate(wavy), f(u), g(u), s(u);
  body.motion.set_zero(u);
  u.zero_out_ghost_values();
  A.vmult(f, u);
  // vmult() leaves its source as it was: without ghost values.
  EXPECT_FALSE(u.has_ghost_elements());
  A.matrix().vmult(g, u);
  EXPECT_LT(largest_difference(f, g), 1e-13 * f.linfty_norm());

  without.vmult(g, u);
  s = 0;
  u.update_ghost_values();
  A.add_surface(s, u);
  u.zero_out_ghost_values();
  body.motion.set_zero(s);
  g += s;
  for (unsigned int i = 0; i < g.locally_owned_size(); ++i)
    if (prescribed[i])
      g.local_element(i) = f.local_element(i);
  EXPECT_LT(largest_difference(f, g), 1e-13 * f.linfty_norm());

  const double size = A.diagonal().linfty_norm();
  for (unsigned int i = 0; i < g.locally_owned_size(); ++i)
    EXPECT_NEAR(A.diagonal().local_element(i),
                A.matrix().diagonal(i),
                1e-13 * size);
}

// Users choose the units: springs that are 1e-14 times as stiff have a matrix
// of that size, and none of them is dropped as too small.
TEST_P(ElasticSupportTest, SizeIsThatOfTheSprings)
{
  Block        weak(GetParam(), supports("z-min: 1e-14; 2e-14; 3e-14", ""));
  Block        stiff(GetParam(), supports("z-min: 1; 2; 3", ""));
  const auto   weak_matrix  = surface_matrix(weak, 1., 0.);
  const auto   stiff_matrix = surface_matrix(stiff, 1., 0.);
  const double size         = stiff_matrix.size();
  EXPECT_GT(size, 0);
  EXPECT_NEAR(weak_matrix.size(), 1e-14 * size, 1e-28 * size);
  EXPECT_EQ(weak_matrix.springs().size(), stiff_matrix.springs().size());
}

// On a coarser element S is P^T S P with the embedding P, as both have the same
// quadrature points and stiffness tensors.
TEST_P(ElasticSupportTest, CoarserLevels)
{
  if (GetParam().degree() == 1)
    return;
  MovingBody              body(half_curved_box(2),
                  element_text(GetParam()) +
                    supports("", "x-max: 1 + y, z-min: 2"));
  const SurfaceMatrix     matrix = surface_matrix(body, 1., 0.);
  SurfaceOperator<double> fine_S(body.discretization);
  fine_S.set(matrix);
  const CoarserNodes      coarser(body.discretization);
  SurfaceOperator<double> coarse_S(coarser);
  coarse_S.set(matrix);

  Vector x, y, z, fine, product;
  for (Vector *vector : {&x, &y, &z})
    coarser.initialize_vector(*vector);
  for (Vector *vector : {&fine, &product})
    body.discretization.initialize_vector(*vector);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    x.local_element(i) = std::sin(1. + x.get_partitioner()->local_to_global(i));
  x.update_ghost_values();
  coarse_S.add(y, x);
  coarser.prolongate_add(fine, x);
  fine.update_ghost_values();
  fine_S.add(product, fine);
  coarser.restrict_to(z, product);
  EXPECT_GT(y.linfty_norm(), 0.01);
  EXPECT_LT(largest_difference(y, z), 1e-14 * 10 * y.linfty_norm());
}

// The boundary is an eighth of a sphere of radius 1 less its pole, with the
// area 2 pi cos(0.3) / 4. Radial displacements of size one have the energy k
// area / 2, rotations about the z axis none. The error of faces of degree q is
// of order h^(q + 1), that of normals h^q, but that of the energy is its
// square; measured with 4 and 8 faces along an edge.
TEST(ElasticSupportOnCurvedFaces, Sphere)
{
  for (const unsigned int q : {2, 3})
    {
      double error[2], rotation[2];
      for (const unsigned int level : {0, 1})
        {
          MovingBody        body(thick_shell(4 << level, q),
                          element_text(q) + supports("", "z-max: 2"));
          const ForceTerms &terms = body.system.equation().terms;
          const Vector      u     = body.interpolate(
            [](const Point<3> &x) { return Tensor<1, 3>(x / x.norm()); });
          const double area = PI / 2 * std::cos(0.3);
          error[level]      = std::abs(terms.energy({0., u, u}) / area - 1);
          const Vector turn = body.interpolate(
            [](const Point<3> &x) { return Tensor<1, 3>({-x[1], x[0], 0}); });
          rotation[level] = terms.energy({0., turn, turn}) / area;
        }
      report(fmt::format("degree {}: error of the energy", q), error[1]);
      report(fmt::format("degree {}: energy of a rotation", q), rotation[1]);
      // Errors have order 4 for q = 2 and 3, rotations order 2 q, less some
      // tenths as the meshes are coarse.
      EXPECT_LT(error[1], 1e-4);
      EXPECT_LT(error[1], error[0] / std::pow(2, 3.6));
      EXPECT_LT(rotation[1], rotation[0] / std::pow(2, 2 * q - 0.6));
    }
}

// Springs that are the same everywhere give the area of the faces.
TEST(ElasticSupportOnCurvedFaces, Area)
{
  MovingBody   body(thick_shell(8, 3),
                  element_text(3) + supports("z-max: 1; 1; 1"));
  const Vector u = translation(body, Tensor<1, 3>({1, 0, 0}));
  EXPECT_NEAR(total(force(body, u))[0], -PI / 2 * std::cos(0.3), 1e-5);
}

// Dashpots resist the velocity.
TEST(Dashpots, Force)
{
  Block             body(2, supports("", "", "z-min: 1 + t; 5; 0"));
  const ForceTerms &terms = body.system.equation().terms;
  const Vector      u     = body.interpolate(wavy);
  const Vector      v     = translation(body, Tensor<1, 3>({2, 3, 4}));
  Vector            f;
  body.discretization.initialize_vector(f);
  terms.damping_force(f, {3., u, v});
  EXPECT_NEAR(total(f)[0], 2 * 4 * 2., 1e-13 * 16);
  EXPECT_NEAR(total(f)[1], 3 * 5 * 2., 1e-13 * 30);
  EXPECT_EQ(total(f)[2], 0);
  EXPECT_TRUE(terms.has_surface_damping());
  EXPECT_TRUE(terms.surface_matrix_depends_on_time());
  EXPECT_FALSE(terms.has_elastic());
  EXPECT_EQ(terms.energy({3., u, v}), 0);
}

// A wrong value at a later time is reported with the same entry as one at the
// start, and afterwards the energy at other times is as before.
TEST(Supports, WrongValuesOfLaterTimes)
{
  Block             body(1, supports("z-min: 1 - t; 0; 0"));
  const ForceTerms &terms  = body.system.equation().terms;
  const Vector      u      = translation(body, Tensor<1, 3>({2, 3, 4}));
  const double      energy = terms.energy({0.5, u, u});
  try
    {
      terms.energy({3., u, u});
      FAIL() << "nothing was refused";
    }
  catch (const WrongValueError &error)
    {
      EXPECT_EQ(error.cause.entry, "Supports/Elastic");
      const std::string text = error.cause.what();
      EXPECT_TRUE(text.starts_with("found the value -2 at (")) << text;
      EXPECT_TRUE(text.ends_with(" at t = 3; allowed: finite values, none "
                                 "below zero"))
        << text;
      EXPECT_EQ(error.what(), "Supports/Elastic: " + text);
      EXPECT_EQ(error.exit_status, 2);
    }
  EXPECT_EQ(terms.energy({0.5, u, u}), energy);
}

// Without the section there are no springs, nor with zero stiffness.
TEST(Supports, Absent)
{
  for (const std::string &text : {std::string(), supports("z-min: 0; 0; 0")})
    {
      MovingBody        body(box("2, 1, 1", "2, 1, 1"), text);
      const ForceTerms &terms = body.system.equation().terms;
      EXPECT_FALSE(terms.has_surface_matrix());
      EXPECT_FALSE(terms.has_elastic());
      EXPECT_EQ(body.system.equation().terms.springs(body.reference, 0.),
                nullptr);
      EXPECT_EQ(body.system.equation().last_forces().elastic.size(), 0u);
    }
}

TEST(Supports, Refusals)
{
  const auto refusal_of = [](const std::string &entry,
                             const std::string &value) {
    return refusal([&] {
      MovingBody body(box("1, 1, 1", "1, 1, 1"),
                      section("Supports", {{entry, value}}));
    });
  };
  EXPECT_EQ(refusal_of("Elastic", "z-mix: 1; 1; 1"),
            "Supports/Elastic: no such boundary: found 'z-mix'; the mesh has "
            "the boundaries: x-min, x-max, y-min, y-max, z-min, z-max; did you "
            "mean 'z-min'?");
  EXPECT_EQ(refusal_of("Elastic", "z-min"),
            "Supports/Elastic: found 'z-min'; allowed: 'boundary: value, "
            "boundary: value'");
  EXPECT_EQ(refusal_of("Dashpots", "z-min: 1; 2"),
            "Supports/Dashpots: the expression \"1; 2\" has 2 components; 3 "
            "are needed, separated by semicolons");
  EXPECT_EQ(refusal_of("Elastic normal", "z-min: 1; 2; 3"),
            "Supports/Elastic normal: the expression \"1; 2; 3\" has 3 "
            "components; 1 is needed, separated by semicolons");
  EXPECT_EQ(refusal_of("Elastic", "z-min: 1; 1; 1, z-min: 2; 2; 2"),
            "Supports/Elastic: found boundary 'z-min' twice; allowed: each "
            "boundary once");
  // The message may name any point of the quadrature rule.
  for (const std::string value : {"-1", "1 / 0", "sqrt(-1)", "x - 0.5"})
    {
      const std::string text = refusal_of("Elastic normal", "z-min: " + value);
      EXPECT_TRUE(text.starts_with("Supports/Elastic normal: found the value "))
        << text;
      EXPECT_TRUE(text.ends_with("of boundary 'z-min' at t = 0; allowed: "
                                 "finite values, none below zero"))
        << text;
    }
}
