// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Degree 1 with rotations of the vertices, as the lowest level of p-multigrid:
// its functions, their matrix, and how few iterations thin bodies take
// with them.

#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/p_multigrid.h>
#include <corotet/solvers/vertex_motions.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "../curved_mesh.h"
#include "clamped_body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  using FloatVector = VertexMotions::FloatVector;
  using Field       = std::function<Tensor<1, 3>(const Point<3> &)>;

  // A body of degree 2, its stiffness with springs at a side, and the same
  // operators for the motions of its vertices.
  struct Motions
  {
    Motions(const SerialMesh &mesh, const std::string &entries)
      : body(mesh, element_text(2) + entries)
      , springs(body.discretization, body.reference)
      , has_springs(body.system.equation().terms.has_surface_matrix())
      , A(body.discretization,
          body.elasticity,
          body.mass,
          body.motion.is_prescribed(),
          has_springs ? &springs : nullptr)
      , vertices(body.discretization)
      , motions(body.discretization, vertices, body.motion.is_prescribed())
      , surface(body.discretization)
    {}

    void
    update(const double c_M)
    {
      if (has_springs)
        {
          springs.clear();
          body.system.equation().terms.surface_matrix(
            springs, body.system.equation().motion(0.), 1., 0.);
          surface.set(springs);
        }
      A.update(1., c_M);
      motions.update(body.discretization,
                     body.discretization.node_positions(),
                     1.,
                     body.elasticity.coefficients(),
                     c_M,
                     body.mass.cell_masses(),
                     has_springs ? &surface : nullptr);
    }

    // The coarse unknowns for a displacement u and a rotation w at the
    // vertices.
    std::vector<double>
    unknowns(const Field &u, const Field &w) const
    {
      std::vector<double> result;
      for (unsigned int v = 0; v < vertices.n_owned_nodes(); ++v)
        {
          const Point<3> x = body.discretization.node_position(vertices.key(v));
          const double   length = motions.aggregates().frames[v].motions[3][3];
          for (unsigned int a = 0; a < 3; ++a)
            result.push_back(u(x)[a]);
          for (unsigned int a = 0; a < 3; ++a)
            result.push_back(length * w(x)[a]);
        }
      return result;
    }

    FloatVector
    prolongate(const std::vector<double> &coarse) const
    {
      FloatVector x;
      body.discretization.initialize_vector(x);
      const std::vector<float> single(coarse.begin(), coarse.end());
      motions.prolongate_add(x, single.data());
      return x;
    }

    // Twice the energies of these motions: by their own matrix, and of the
    // quadratic function by A.
    std::pair<double, double>
    energies(const std::vector<double> &coarse) const
    {
      std::vector<double> product(coarse.size());
      motions.matrix().vmult(product.data(), coarse.data());
      double own = 0;
      for (unsigned int i = 0; i < coarse.size(); ++i)
        own += coarse[i] * product[i];
      const FloatVector single = prolongate(coarse);
      Vector            x(body.state.u), Ax(x);
      for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
        x.local_element(i) = single.local_element(i);
      A.vmult(Ax, x);
      return {dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD), x * Ax};
    }

    MovingBody              body;
    SurfaceMatrix           springs;
    const bool              has_springs;
    EffectiveOperator       A;
    CoarserNodes            vertices;
    VertexMotions           motions;
    SurfaceOperator<double> surface;
  };

  // The rotation vector of a rigid motion, which also has a translation.
  const Tensor<1, 3> spin({0.3, -0.7, 0.4});

  Tensor<1, 3>
  rigid(const Point<3> &x)
  {
    return Tensor<1, 3>({0.2, 0.5, -0.1}) + cross_product_3d(spin, x);
  }

  Tensor<1, 3>
  rigid_rotation(const Point<3> &)
  {
    return spin;
  }

  // Bending of constant curvature about y, and its rotation.
  Tensor<1, 3>
  bend(const Point<3> &x)
  {
    return Tensor<1, 3>({x[0] * x[2], 0., -0.5 * x[0] * x[0]});
  }

  Tensor<1, 3>
  rotation_of_bend(const Point<3> &x)
  {
    return Tensor<1, 3>({0., x[0], 0.});
  }

  Tensor<1, 3>
  wave(const Point<3> &x)
  {
    return Tensor<1, 3>({std::sin(2 * x[0] + x[1]),
                         std::cos(x[1] - 2 * x[2]),
                         std::sin(x[0] * x[1])});
  }
} // namespace

// The deflection of a bend is exact, and so are displacements along the body on
// the layers of vertices. On edges between layers, these get only half of what
// a bend adds to the mean of the ends, x z / 4. Arms are in single precision:
// some roundings of numbers of size one.
TEST(VertexMotions, BendOfConstantCurvature)
{
  Motions m(box("2, 1, 0.5", "4, 3, 2"), "");
  m.update(0);
  const FloatVector x = m.prolongate(m.unknowns(bend, rotation_of_bend));
  for (unsigned int n = 0; n < m.body.discretization.n_owned_nodes(); ++n)
    {
      const Point<3>     place = m.body.discretization.node_position(n);
      const Tensor<1, 3> exact = bend(place);
      const double       layer = place[2] / 0.25;
      const bool   is_on_layer = std::abs(layer - std::round(layer)) < 1e-6;
      const double off         = std::abs(x.local_element(3 * n) - exact[0]);
      EXPECT_LE(off, is_on_layer ? 1e-6 : 0.5 * 0.25 / 8 + 1e-6);
      EXPECT_NEAR(x.local_element(3 * n + 1), 0, 1e-6);
      EXPECT_NEAR(x.local_element(3 * n + 2), exact[2], 1e-6);
    }
}

// Rigid motions are exact, on curved edges, too, and no force resists them. K
// has entries of up to some ten, so that sums of 1e3 of them have errors of
// 1e-12.
TEST(VertexMotions, RigidMotions)
{
  for (const bool is_curved : {false, true})
    {
      Motions m(is_curved ? half_curved_box(2) : box("2, 1, 0.5", "4, 3, 2"),
                "");
      m.update(0);
      const auto        c = m.unknowns(rigid, rigid_rotation);
      const FloatVector x = m.prolongate(c);
      for (unsigned int n = 0; n < m.body.discretization.n_owned_nodes(); ++n)
        {
          const Tensor<1, 3> exact =
            rigid(m.body.discretization.node_position(n));
          for (unsigned int a = 0; a < 3; ++a)
            EXPECT_NEAR(x.local_element(3 * n + a), exact[a], 1e-6);
        }
      std::vector<double> force(c.size());
      m.motions.matrix().vmult(force.data(), c.data());
      double largest = 0, size = 0;
      for (unsigned int i = 0; i < force.size(); ++i)
        {
          largest = std::max(largest, std::abs(force[i]));
          size    = std::max(size, m.motions.matrix().diagonal(i));
        }
      EXPECT_LE(largest, 1e-13 * size) << is_curved;
    }
}

// The energy of a motion is that of its quadratic function, mass and springs at
// the surface included, plus that of the weak springs of its rotations. Single
// precision limits its accuracy to 1e-6.
TEST(VertexMotions, Energy)
{
  for (const std::string &entries : {std::string(),
                                     fixed("x-min"),
                                     section("Supports",
                                             {{"Elastic", "x-min: 5; 1; 2"},
                                              {"Elastic normal", "z-max: 3"}})})
    for (const bool is_curved : {false, true})
      for (const double c_M : {0., 100.})
        {
          Motions m(is_curved ? half_curved_box(2) :
                                box("2, 1, 0.5", "4, 3, 2"),
                    entries);
          m.update(c_M);
          const bool  is_free = entries.find("Fixed") == std::string::npos;
          const Field held    = [&](const Point<3> &x) {
            return is_free ? wave(x) : x[0] * wave(x);
          };
          const auto [own, exact] = m.energies(m.unknowns(held, wave));
          // The springs of rotations have no energy in a rigid rotation: then
          // both energies are equal.
          if (is_free)
            {
              const auto [of_matrix, of_A] =
                m.energies(m.unknowns(rigid, rigid_rotation));
              EXPECT_NEAR(of_matrix, of_A, 1e-6 * exact)
                << entries << is_curved;
            }
          EXPECT_GE(own, (1 - 1e-5) * exact) << entries << is_curved;
          EXPECT_LE(own, 1.05 * exact) << entries << is_curved;
        }
}

TEST(VertexMotions, RestrictionIsTheTranspose)
{
  Motions m(half_curved_box(2), fixed("x-min"));
  m.update(0);
  const auto        c = m.unknowns(bend, rigid);
  const FloatVector x = m.prolongate(c);
  FloatVector       r(x);
  for (unsigned int n = 0; n < m.body.discretization.n_owned_nodes(); ++n)
    for (unsigned int a = 0; a < 3; ++a)
      r.local_element(3 * n + a) =
        m.body.motion.is_prescribed()[3 * n + a] != 0 ?
          0. :
          wave(m.body.discretization.node_position(n))[a];
  std::vector<float> coarse(c.size());
  m.motions.restrict_to(coarse.data(), r);
  double own = 0;
  for (unsigned int i = 0; i < c.size(); ++i)
    own += c[i] * coarse[i];
  EXPECT_NEAR(dealii::Utilities::MPI::sum(own, MPI_COMM_WORLD), x * r, 1e-4);
}

struct Thin
{
  const char *name, *size, *cells;
  // The iterations for degrees 2 and 3, plus a tenth.
  unsigned int most[2];
};

class VertexRotations : public testing::TestWithParam<Thin>
{};

// With the rotations of vertices a fraction of the iterations is enough, the
// same number on any number of ranks, up to the round-off of sums in single
// precision.
TEST_P(VertexRotations, IterationsAreFew)
{
  for (const unsigned int degree : {2, 3})
    {
      const ClampedBody body(GetParam().size,
                             GetParam().cells,
                             element_text(degree));
      const auto        iterations_with = [&](const std::string &rotations) {
        PMultigrid               multigrid;
        dealii::ParameterHandler prm;
        multigrid.declare_parameters(prm);
        prm.set("Vertex rotations", rotations);
        multigrid.build(body.A, body.displacement());
        EXPECT_EQ(multigrid.lowest_level().has_rotations(),
                  rotations != "false");
        return iterations(body, multigrid);
      };
      const unsigned int with    = iterations_with("automatic"),
                         without = iterations_with("false");
      report(GetParam().name + (" P" + std::to_string(degree)), with);
      EXPECT_LE(with, GetParam().most[degree - 2]) << degree;
      EXPECT_GE(without, 2 * with) << degree;
    }
}

INSTANTIATE_TEST_SUITE_P(
  All,
  VertexRotations,
  testing::Values(Thin{"plate", "1, 1, 0.01", "10, 10, 1", {80, 220}},
                  Thin{"finer", "1, 1, 0.01", "20, 20, 1", {43, 73}},
                  Thin{"flat", "1, 1, 0.0333", "8, 8, 8", {166, 300}},
                  Thin{"stretched", "30, 1, 1", "8, 8, 8", {66, 191}}),
  [](const auto &info) { return std::string(info.param.name); });
