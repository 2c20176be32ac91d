// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Hyperelastic laws compared with what GiNaC derives from their textbook
// energies: the stress, its derivative, and the body force of an exact
// solution.

#include <corotet/laws/neo_hookean.h>
#include <corotet/laws/saint_venant_kirchhoff.h>
#include <corotet/material/exact_solution.h>

#include <ginac/ginac.h>
#include <gtest/gtest.h>

#include <memory>

using namespace corotet;
using dealii::Point;
using dealii::Tensor;

namespace
{
  using Matrix = std::array<std::array<GiNaC::ex, 3>, 3>;

  const IsotropicMaterial material_of_laws = isotropic_material(10., 0.3, 1.);

  struct SymbolicLaw
  {
    std::string                               name;
    std::shared_ptr<const MaterialLaw>        law;
    std::function<GiNaC::ex(const Matrix &F)> energy;
  };

  GiNaC::ex
  determinant(const Matrix &F)
  {
    return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
           F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
           F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
  }

  // The right Cauchy-Green tensor F^T F.
  Matrix
  cauchy_green(const Matrix &F)
  {
    Matrix C;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        for (unsigned int c = 0; c < 3; ++c)
          C[a][b] += F[c][a] * F[c][b];
    return C;
  }

  GiNaC::ex
  saint_venant_kirchhoff(const Matrix &F)
  {
    const Matrix C     = cauchy_green(F);
    GiNaC::ex    trace = 0, square = 0;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        {
          const GiNaC::ex E = (C[a][b] - (a == b ? 1 : 0)) / 2;
          square += E * E;
          if (a == b)
            trace += E;
        }
    return material_of_laws.lambda / 2 * trace * trace +
           material_of_laws.mu * square;
  }

  GiNaC::ex
  neo_hookean(const Matrix &F)
  {
    const Matrix    C  = cauchy_green(F);
    const GiNaC::ex ln = GiNaC::log(determinant(F));
    return material_of_laws.mu / 2 * (C[0][0] + C[1][1] + C[2][2] - 3) -
           material_of_laws.mu * ln + material_of_laws.lambda / 2 * ln * ln;
  }

  const std::vector<SymbolicLaw> laws{{"Saint Venant-Kirchhoff",
                                       saint_venant_kirchhoff_law(),
                                       saint_venant_kirchhoff},
                                      {"neo-Hookean",
                                       neo_hookean_law(),
                                       neo_hookean}};

  double
  number(const GiNaC::ex &value)
  {
    return GiNaC::ex_to<GiNaC::numeric>(value.evalf()).to_double();
  }
} // namespace

TEST(SymbolicLaws, StressAndItsDerivative)
{
  GiNaC::symbol symbols[3][3];
  Matrix        F;
  GiNaC::exmap  values;
  Tensor<2, 3> F_values({{1.3, 0.4, -0.2}, {-0.3, 0.8, 0.1}, {0.2, -0.1, 1.1}});
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      {
        F[a][b]               = symbols[a][b];
        values[symbols[a][b]] = F_values[a][b];
      }
  Tensor<2, 3> H = F_values;
  for (unsigned int a = 0; a < 3; ++a)
    H[a][a] -= 1;
  for (const auto &[name, law, energy] : laws)
    {
      const GiNaC::ex W = energy(F);
      // The tolerance is that of some ten operations on numbers up to 30.
      EXPECT_NEAR(law->energy_density(material_of_laws, H),
                  number(W.subs(values)),
                  1e-14)
        << name;
      const Tensor<2, 3> P = law->stress(material_of_laws, H);
      for (unsigned int a = 0; a < 3; ++a)
        for (unsigned int b = 0; b < 3; ++b)
          {
            const GiNaC::ex stress = W.diff(symbols[a][b]);
            EXPECT_NEAR(P[a][b], number(stress.subs(values)), 1e-13) << name;
            for (unsigned int c = 0; c < 3; ++c)
              for (unsigned int d = 0; d < 3; ++d)
                {
                  Tensor<2, 3> dF;
                  dF[c][d] = 1;
                  EXPECT_NEAR(law->stress_derivative(material_of_laws,
                                                     H,
                                                     dF)[a][b],
                              number(stress.diff(symbols[c][d]).subs(values)),
                              1e-13)
                    << name;
                }
          }
    }
}

// The body force is -Div P, for a displacement that rotates, stretches and
// shears.
TEST(SymbolicLaws, BodyForce)
{
  const GiNaC::symbol x("x"), y("y"), z("z");
  const std::string   text =
    "-x - y - 0.2*sin(3*x+y)*cos(z); x - y + 0.15*cos(2*y-x+z); "
    "0.1*sin(2*x+y)*exp(z)";
  const GiNaC::ex     u[3]{-x - y - 0.2 * sin(3 * x + y) * cos(z),
                           x - y + 0.15 * cos(2 * y - x + z),
                           0.1 * sin(2 * x + y) * exp(z)};
  const GiNaC::symbol coordinates[3]{x, y, z};
  GiNaC::symbol       symbols[3][3];
  Matrix              F;
  GiNaC::exmap        gradient;
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; b < 3; ++b)
      {
        F[a][b]                 = symbols[a][b];
        gradient[symbols[a][b]] = u[a].diff(coordinates[b]) + (a == b ? 1 : 0);
      }
  const GiNaC::exmap  point{{x, 0.2}, {y, 0.4}, {z, 0.3}};
  const ExactSolution solution(text);
  for (const auto &[name, law, energy] : laws)
    {
      const auto b = solution.body_force(
        material_of_laws, *law, false, Point<3>(0.2, 0.4, 0.3), 0.);
      const GiNaC::ex W = energy(F);
      for (unsigned int a = 0; a < 3; ++a)
        {
          GiNaC::ex divergence = 0;
          for (unsigned int c = 0; c < 3; ++c)
            divergence +=
              W.diff(symbols[a][c]).subs(gradient).diff(coordinates[c]);
          // The tolerance is that of some hundred operations on numbers up to
          // 100.
          EXPECT_NEAR(b[a], -number(divergence.subs(point)), 1e-12) << name;
        }
    }
}
