// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// With every preconditioner conjugate gradients find the same solution, on one
// rank and on two, up to the required residual and its round-off.

#include <gtest/gtest.h>

#include "../body.h"
#include "preconditioner_names.h"
#include "solved_beam.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Point;
using dealii::Tensor;

class PreconditionerTest : public testing::TestWithParam<std::string>
{};

// A clamped beam in statics (the ill-conditioned case), for all degrees. The
// residual is computed with the matrix; the tolerance is the one given.
TEST_P(PreconditionerTest, SolvesClampedBeam)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      MovingBody        body(box("4, 1, 1", "4, 1, 1", 0.1),
                      element_text(degree) + fixed("x-min") +
                        linear_solver(GetParam(), 1e-12));
      const auto       &motion = body.motion;
      EffectiveOperator A(body.discretization,
                          body.elasticity,
                          body.mass,
                          motion.is_prescribed());
      A.update(1., 0.);
      Vector expected(body.state.u), b(expected), x(expected), r(expected);
      expected.copy_locally_owned_data_from(
        body.interpolate([](const Point<3> &p) {
          return Tensor<1, 3>({p[0] * p[1], p[0], p[0] * p[0]});
        }));
      motion.set_zero(expected);
      A.vmult(b, expected);
      const unsigned int iterations =
        LinearSolver(body.parameters.linear_solver)
          .solve(A, x, b, body.discretization.node_positions());
      A.vmult(r, x);
      r -= b;
      EXPECT_LE(r.l2_norm(), 2e-12 * b.l2_norm());
      EXPECT_GE(iterations, 1u);
      // The condition number of this beam is below 1e6.
      EXPECT_LE(largest_difference(x, expected), 1e-6 * expected.linfty_norm());
      if (GetParam() == "direct")
        {
          EXPECT_LE(iterations, 2u);
        }
    }
}

// All registered preconditioners are tested, also ones added later.
INSTANTIATE_TEST_SUITE_P(All,
                         PreconditionerTest,
                         testing::ValuesIn(preconditioner_names()));

// Both Krylov methods, matrix-free or with the assembled matrix, solve the same
// system; the true residual meets the tolerance up to its round-off.
TEST(LinearSolver, MethodsAndOperators)
{
  for (const std::string method : {"conjugate gradients", "gmres"})
    for (const std::string operator_type : {"matrix-free", "assembled"})
      {
        MovingBody        body(box("4, 1, 1", "8, 2, 2", 0.1),
                        element_text(3) + fixed("x-min") +
                          section("Newton", {{"Tangent", "frozen rotation"}}) +
                          section("Linear solver",
                                         {{"Method", method},
                                          {"Operator", operator_type},
                                          {"Tolerance", 1e-10}}));
        EffectiveOperator A(body.discretization,
                            body.elasticity,
                            body.mass,
                            body.motion.is_prescribed());
        A.update(1., 0.);
        Vector x(body.state.u), b(x), r(x);
        for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
          b.local_element(i) = i % 3;
        body.motion.set_zero(b);
        const unsigned int iterations =
          LinearSolver(body.parameters.linear_solver)
            .solve(A, x, b, body.discretization.node_positions());
        A.vmult(r, x);
        r -= b;
        EXPECT_LE(r.l2_norm(), 2e-10 * b.l2_norm()) << method << operator_type;
        EXPECT_GT(iterations, 5u);
        EXPECT_LE(iterations, 25u);
      }
}

TEST(LinearSolver, FailureIsClear)
{
  MovingBody        body(box("4, 1, 1", "4, 1, 1"),
                  fixed("x-min") +
                    section("Linear solver",
                                   {{"Type", "jacobi"}, {"Maximum iterations", 3}}));
  EffectiveOperator A(body.discretization,
                      body.elasticity,
                      body.mass,
                      body.motion.is_prescribed());
  A.update(1., 0.);
  Vector x(body.state.u), b(x);
  b = 1.;
  body.motion.set_zero(b);
  try
    {
      LinearSolver(body.parameters.linear_solver)
        .solve(A, x, b, body.discretization.node_positions());
      FAIL() << "nothing was thrown";
    }
  catch (const ComputationError &error)
    {
      EXPECT_EQ(std::string(error.what())
                  .find("the linear solver stopped after 3 iterations at a "
                        "relative residual of "),
                0u)
        << error.what();
      EXPECT_EQ(error.exit_status, 2);
    }
}

namespace
{
  // A preconditioner that a program adds: a multiple of the identity.
  class Multiple : public Preconditioner
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Factor", factor);
    }

    void
    build(const EffectiveOperator &, const Vector &) override
    {
      ++n_builds;
    }

    void
    vmult(Vector &dst, const Vector &src) const override
    {
      dst.equ(factor, src);
    }

    static inline unsigned int n_builds = 0;

  private:
    double factor = 1;
  };
} // namespace

// A preconditioner that a program adds is selected like those of the library.
// Its factor, a power of two, does not change conjugate gradients at all.
TEST(LinearSolver, PreconditionerOfAnotherProgram)
{
  const AddedCandidate<Preconditioner> multiple(
    candidate<Preconditioner, Multiple>("multiple"));
  const auto solve = [](const unsigned int factor) {
    return solve_beam("4, 1, 1",
                      1,
                      {{"Type", "multiple"},
                       section("multiple", {{"Factor", factor}})});
  };
  Multiple::n_builds = 0;
  const Solved one = solve(1), four = solve(4);
  EXPECT_EQ(Multiple::n_builds, 2u);
  EXPECT_GT(one.iterations,
            solve_beam("4, 1, 1", 1, {{"Type", "direct"}}).iterations);
  EXPECT_EQ(one.iterations, four.iterations);
  EXPECT_EQ(one.x, four.x);
}
