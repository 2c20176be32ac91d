// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Corotational elasticity compared with an exact solution with rotations of 90
// degrees over the body: orders of convergence for every placement of
// rotations.

#include <corotet/time_integration/load_stepping.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/numerics/vector_tools.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <vector>

#include "../body.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

namespace
{
  // The box 0.4 x pi/2 x 0.4 bent by a right angle about z and turned as a
  // whole by Q, x = Q (r(X) cos(Y) - r(0), r(X) sin(Y), g(Z)). With the
  // rotation R(Y) about z,
  //
  //   F = Q R diag(r', r, g'), so P = Q R diag(sigma_1, sigma_2, sigma_3),
  //
  // sigma_i = 2 mu (S_i - 1) + lambda (tr S - 3) of X and Z, and the body force
  //
  //   b = -div P = -Q (R e_1 (d sigma_1 / dX - sigma_2) + e_3 d sigma_3 / dZ).
  //
  // Strains are up to 20 %, so errors do not vanish because strains are small.
  class Bending : public dealii::Function<3>
  {
  public:
    Bending()
      : dealii::Function<3>(3)
    {}

    double
    value(const Point<3> &x, const unsigned int component) const override
    {
      const Tensor<1, 3> bent(
        {r(x[0]) * std::cos(x[1]) - r(0), r(x[0]) * std::sin(x[1]), g(x[2])});
      return (Q * bent)[component] - x[component];
    }

    Tensor<1, 3>
    gradient(const Point<3> &x, const unsigned int component) const override
    {
      const double S[3]{1 + 0.1 * std::cos(6 * x[0]),
                        r(x[0]),
                        1 + 0.1 * std::cos(5 * x[2])};
      Tensor<2, 3> F = Q * rotation_about(Tensor<1, 3>({0., 0., 1.}), x[1]);
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          F[a][b] = F[a][b] * S[b] - (a == b ? 1 : 0);
      return F[component];
    }

    // The exact displacement, as expressions in x, y, z.
    std::string
    displacement() const
    {
      return turned({"(r)*cos(y)-(r0)", "(r)*sin(y)", "g"}, true);
    }

    std::string
    body_force() const
    {
      const std::string radial =
        fmt::format("(({})*(r2)+({})*(r1)-(s2))", lambda + 2 * mu, lambda);
      return turned({"-cos(y)*" + radial,
                     "-sin(y)*" + radial,
                     fmt::format("-({})*(g2)", lambda + 2 * mu)},
                    false);
    }

    // The traction on the face at the end of axis @p direction, at its start
    // for @p sign = -1 and its end for 1.
    std::string
    traction(const unsigned int direction, const int sign) const
    {
      const std::string s = sign > 0 ? "" : "-";
      if (direction == 0)
        return turned({s + "cos(y)*(s1)", s + "sin(y)*(s1)", "0"}, false);
      if (direction == 1)
        return turned({s + "-sin(y)*(s2)", s + "cos(y)*(s2)", "0"}, false);
      return turned({"0", "0", s + "(s3)"}, false);
    }

    static constexpr double E = 10, nu = 0.3;

  private:
    static double
    r(const double x)
    {
      return 0.79 + x + std::sin(6 * x) / 60;
    }

    static double
    g(const double z)
    {
      return z + std::sin(5 * z) / 50;
    }

    // Q times a vector of expressions in the abbreviations of the class.
    std::string
    turned(const std::vector<std::string> &components,
           const bool                      less_position) const
    {
      std::string text;
      for (unsigned int a = 0; a < 3; ++a)
        {
          text += a > 0 ? "; " : "";
          for (unsigned int b = 0; b < 3; ++b)
            text += fmt::format("{}({:.17g})*({})",
                                b > 0 ? "+" : "",
                                Q[a][b],
                                components[b]);
          if (less_position)
            text += std::string("-") + "xyz"[a];
        }
      const std::string trace = "((r1)+(r)+(g1)-3)";
      const auto        sigma = [&](const std::string &S) {
        return fmt::format("{}*({}-1)+{}*{}", 2 * mu, S, lambda, trace);
      };
      for (const auto &[name, meaning] :
           std::vector<std::pair<std::string, std::string>>{
             {"(s1)", "(" + sigma("(r1)") + ")"},
             {"(s2)", "(" + sigma("(r)") + ")"},
             {"(s3)", "(" + sigma("(g1)") + ")"},
             {"(r0)", "0.79"},
             {"(r)", "(0.79+x+sin(6*x)/60)"},
             {"(r1)", "(1+0.1*cos(6*x))"},
             {"(r2)", "(-0.6*sin(6*x))"},
             {"(g)", "(z+sin(5*z)/50)"},
             {"(g1)", "(1+0.1*cos(5*z))"},
             {"(g2)", "(-0.5*sin(5*z))"}})
        for (std::size_t at = text.find(name); at != std::string::npos;
             at             = text.find(name))
          text.replace(at, name.size(), meaning);
      return text;
    }

    const double       lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
    const double       mu     = E / (2 * (1 + nu));
    const Tensor<2, 3> Q      = rotation_about(Tensor<1, 3>({1., 2., 3.}), 1.);
  };

  struct Errors
  {
    double L2, H1;
  };

  // The errors on a mesh of n x 4n x n cuboids, whose inner vertices are moved.
  // Two sides have the exact displacement, the others the exact traction.
  Errors
  bending_errors(const unsigned int degree,
                 const std::string &rotation,
                 const unsigned int n)
  {
    const Bending bending;
    MovingBody    body(
      box("0.4, 1.5707963267948966, 0.4",
          fmt::format("{0}, {1}, {0}", n, 4 * n),
          0.1),
      element_text(degree) + rotation_at(rotation) +
        material_text(Bending::E, Bending::nu) +
        displacements(
          fmt::format("y-min: {0}, x-min: {0}", bending.displacement())) +
        tractions(fmt::format("y-max: {}, x-max: {}, z-min: {}, z-max: {}",
                              bending.traction(1, 1),
                              bending.traction(0, 1),
                              bending.traction(2, -1),
                              bending.traction(2, 1))) +
        section("Loads", {{"Body force", bending.body_force()}}) +
        section("Newton", {{"Tangent", "consistent"}}) +
        newton_tolerances(1e-11));
    Vector u = body.interpolate([&](const Point<3> &x) {
      Tensor<1, 3> value;
      for (unsigned int a = 0; a < 3; ++a)
        value[a] = bending.value(x, a);
      return value;
    });
    body.state.u.copy_locally_owned_data_from(u);
    LoadStepping load_stepping;
    load_stepping.step(body.system, {0., 1., 1.}, body.state);
    u.zero_out_ghost_values();
    u.copy_locally_owned_data_from(body.state.u);
    u.update_ghost_values();

    const dealii::QWitherdenVincentSimplex<3> rule(degree + 2);
    const auto error = [&](const dealii::VectorTools::NormType norm) {
      dealii::Vector<float> by_cell(body.mesh.triangulation().n_active_cells());
      dealii::VectorTools::integrate_difference(
        body.discretization.mapping(),
        body.discretization.dof_handler(),
        u,
        bending,
        by_cell,
        rule,
        norm);
      return dealii::VectorTools::compute_global_error(
        body.mesh.triangulation(), by_cell, norm);
    };
    return {error(dealii::VectorTools::L2_norm),
            error(dealii::VectorTools::H1_seminorm)};
  }
} // namespace

class LargeRotations
  : public testing::TestWithParam<std::tuple<unsigned int, std::string>>
{};

TEST_P(LargeRotations, OrdersOfConvergence)
{
  const auto &[degree, rotation] = GetParam();
#ifdef DEBUG
  const unsigned int finest = degree == 3 ? 4 : 8;
#else
  const unsigned int finest = degree == 1 ? 16 : degree == 2 ? 12 : 8;
#endif
  std::vector<Errors> errors;
  double              L2 = 0, H1 = 0;
  for (unsigned int n = finest / 4; n <= finest; n *= 2)
    {
      const std::string what =
        fmt::format("P{}, {}, n = {}", degree, rotation, n);
      errors.push_back(bending_errors(degree, rotation, n));
      report("L2 error, " + what, errors.back().L2);
      report("H1 error, " + what, errors.back().H1);
      if (errors.size() == 1)
        continue;
      const Errors &coarse = errors[errors.size() - 2];
      L2                   = std::log2(coarse.L2 / errors.back().L2);
      H1                   = std::log2(coarse.H1 / errors.back().H1);
      report("L2 order, " + what, L2);
      report("H1 order, " + what, H1);
    }
  // One rotation per cell leaves out an error of O(h) times the strain, here 20
  // %, for any degree; it averages to O(h^2) in a cell.
  const bool by_cell = rotation != "quadrature points";
  EXPECT_NEAR(L2, by_cell ? 2 : degree + 1, 0.15);
  EXPECT_NEAR(H1, by_cell ? 1 : degree, 0.15);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  LargeRotations,
  testing::Combine(testing::Values(1u, 2u, 3u),
                   testing::Values("cell centre",
                                   "quadrature points",
                                   "cell centre, variational")));
