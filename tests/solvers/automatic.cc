// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The automatic choice of a preconditioner: p-multigrid where cells are well
// shaped, a sparse factorisation where that is faster, from the start or in the
// middle of a solve; and the change back.

#include <corotet/solvers/automatic.h>
#include <corotet/solvers/linear_solver.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include "../memory_archive.h"
#include "clamped_body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A body and its solver. The multigrid is without rotations of vertices,
  // which makes it slow on thin bodies.
  struct Case : public ClampedBody
  {
    Case(const std::string &size,
         const std::string &cells,
         const unsigned int degree,
         const std::string &type,
         const std::string &vertex_rotations = "false")
      : ClampedBody(
          size,
          cells,
          element_text(degree) + linear_solver(type, 1e-10) +
            section("Linear solver",
                    {section("p-multigrid",
                             {{"Vertex rotations", vertex_rotations}})}))
      , solver(body.parameters.linear_solver)
      , x(b)
    {}

    unsigned int
    solve()
    {
      return solver.solve(A, x, b, displacement());
    }

    LinearSolver solver;
    Vector       x;
  };

  std::shared_ptr<PMultigridParameters>
  slow_multigrid()
  {
    auto parameters              = std::make_shared<PMultigridParameters>();
    parameters->vertex_rotations = "false";
    return parameters;
  }

  // The size of one layer of cells that are flat by 12; on several ranks, where
  // iterations cost less relative to a factorisation, by 20.
  std::string
  thin_size()
  {
    return dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1 ?
             "1, 1, 0.02" :
             "1, 1, 0.0125";
  }

  const std::string thin_cells = "4, 4, 1";
} // namespace

class Automatic : public testing::TestWithParam<unsigned int>
{};

// For degree 1 the multigrid itself is a factorisation, so degrees are higher.
class AutomaticAboveDegree1 : public Automatic
{};

// For well shaped cells only the multigrid is used, with results equal to the
// last bit.
TEST_P(Automatic, LeavesWellShapedBodiesToMultigrid)
{
  Case automatic("4, 1, 1", "8, 2, 2", GetParam(), "automatic");
  Case multigrid("4, 1, 1", "8, 2, 2", GetParam(), "p-multigrid");
  for (int solve = 0; solve < 2; ++solve)
    {
      EXPECT_EQ(automatic.solve(), multigrid.solve());
      EXPECT_EQ(largest_difference(automatic.x, multigrid.x), 0);
    }
  EXPECT_EQ(automatic.solver.take_news(), "");
  EXPECT_EQ(automatic.solver.preconditioner_builds(), 1u);
}

// The first solve gives up the multigrid and goes on with factors; later ones
// need only the few iterations that the round-off of an ill-conditioned matrix
// causes.
TEST_P(AutomaticAboveDegree1, FactorisesThinBodies)
{
  Case automatic(thin_size(), thin_cells, GetParam(), "automatic");
  Case multigrid(thin_size(), thin_cells, GetParam(), "p-multigrid");
  const unsigned int n = multigrid.solve();
  EXPECT_GT(n, 200u);
  EXPECT_LT(automatic.solve(), n);
  EXPECT_NE(automatic.solver.take_news().find("a sparse factorisation"),
            std::string::npos);
  EXPECT_EQ(automatic.solver.take_news(), "");
  // The condition number of the plate is below 1e9, so a residual of 1e-10
  // allows errors of some percent in the smallest components of the solution;
  // they are far less here.
  EXPECT_LT(largest_difference(automatic.x, multigrid.x),
            1e-5 * multigrid.x.linfty_norm());
  EXPECT_LE(automatic.solve(), 3u);
}

// The cells are so flat that the multigrid is not even tried.
TEST_P(AutomaticAboveDegree1, FactorisesVeryFlatCellsAtOnce)
{
  Case automatic("1, 1, 0.005", thin_cells, GetParam(), "automatic");
  EXPECT_LE(automatic.solve(), 3u);
  const std::string news = automatic.solver.take_news();
  EXPECT_NE(news.find("at least"), std::string::npos) << news;
  EXPECT_NE(news.find("100 % of the cells are flat"), std::string::npos)
    << news;
}

// With rotations of the vertices the multigrid is fast enough for a thin body
// of degree 2, and so fewer iterations are expected of it.
TEST(AutomaticWithRotations, LeavesThinBodiesToMultigrid)
{
  Case automatic(thin_size(), thin_cells, 2, "automatic", "automatic");
  Case without(thin_size(), thin_cells, 2, "p-multigrid");
  EXPECT_GT(without.solve(), 2 * automatic.solve());
  EXPECT_EQ(automatic.solver.take_news(), "");
  Case very_thin("1, 1, 0.002", thin_cells, 2, "automatic", "automatic");
  EXPECT_LE(very_thin.solve(), 3u);
  EXPECT_NE(very_thin.solver.take_news().find("at least"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Automatic, testing::Values(1u, 2u, 3u));
INSTANTIATE_TEST_SUITE_P(Degrees,
                         AutomaticAboveDegree1,
                         testing::Values(2u, 3u));

namespace
{
  // Makes the preconditioner change to factors.
  void
  make_it_change(AutomaticPreconditioner &P, Case &c)
  {
    const Vector &displacement = c.displacement();
    P.build(c.A, displacement);
    const unsigned int patience = P.patience(true, false);
    EXPECT_GT(patience, 30u);
    EXPECT_LT(patience, 1000u);
    EXPECT_TRUE(P.change(c.A, nullptr, displacement, patience, patience));
    EXPECT_GT(P.patience(true, false), 1000000u);
  }
} // namespace

// Each of these slow solves costs less than a factorisation, but together they
// cost as much.
TEST(AutomaticDecisions, SlowSolvesAddUp)
{
  Case                    c(thin_size(), thin_cells, 2, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  P.build(c.A, c.displacement());
  const unsigned int first = P.patience(true, false);
  EXPECT_FALSE(P.take_note(30, true));
  EXPECT_EQ(P.patience(true, false), first);
  EXPECT_FALSE(P.take_note(first / 2, false));
  EXPECT_LT(P.patience(true, false), first);
  EXPECT_FALSE(P.take_note(first, false));
  EXPECT_EQ(P.patience(true, false), 30u);
}

// Factors that are outdated again and again are given up; they are tried again,
// each time twice as late.
TEST(AutomaticDecisions, MultigridComesBack)
{
  Case                    c(thin_size(), thin_cells, 3, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  make_it_change(P, c);
  P.take_news();
  EXPECT_FALSE(P.take_note(2, true));
  bool is_back = false;
  for (int solve = 0; solve < 100 && !is_back; ++solve)
    is_back = P.take_note(150, true);
  EXPECT_TRUE(is_back);
  EXPECT_NE(P.take_news().find("p-multigrid again"), std::string::npos);
  const Vector &displacement = c.displacement();
  P.build(c.A, displacement);
  // The preconditioner must now do what the multigrid does.
  PMultigrid multigrid(slow_multigrid());
  multigrid.build(c.A, displacement);
  Vector expected(c.b), found(c.b);
  multigrid.vmult(expected, c.b);
  P.vmult(found, c.b);
  EXPECT_EQ(largest_difference(found, expected), 0);
  const unsigned int patience = P.patience(true, false);
  EXPECT_FALSE(P.take_note(patience, true));
  EXPECT_EQ(P.patience(true, false), 30u);
  EXPECT_TRUE(P.change(c.A, nullptr, displacement, 30, 30));
  EXPECT_NE(P.take_news().find("a sparse factorisation takes the place"),
            std::string::npos);
  EXPECT_FALSE(P.take_note(2, true));
  EXPECT_FALSE(P.take_note(2, false));
  // The mean cost of the multigrid's two solves was less than that of these,
  // and an iteration with factors costs more than one of the multigrid: after
  // ten solves at the latest, factors are known to be slower.
  is_back = false;
  for (int solve = 2; solve < 10 && !is_back; ++solve)
    is_back = P.take_note(patience, true);
  EXPECT_TRUE(is_back);
  EXPECT_GE(P.patience(true, false), 2 * (patience - 30));
}

// The multigrid also comes back where it was not tried: then its expected cost
// counts.
TEST(AutomaticDecisions, MultigridComesBackWhereItWasNotTried)
{
  Case                    c("1, 1, 0.004", thin_cells, 2, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  P.build(c.A, c.displacement());
  EXPECT_GT(P.patience(true, false), 1000000u);
  EXPECT_FALSE(P.take_note(2, true));
  bool is_back = false;
  for (int solve = 0; solve < 100 && !is_back; ++solve)
    is_back = P.take_note(1000, true);
  EXPECT_TRUE(is_back);
}

// Factors that stay good are kept.
TEST(AutomaticDecisions, FactorsStay)
{
  Case                    c(thin_size(), thin_cells, 3, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  make_it_change(P, c);
  EXPECT_FALSE(P.take_note(2, true));
  for (int solve = 0; solve < 100; ++solve)
    EXPECT_FALSE(P.take_note(4, false)) << solve;
}

// A slow solve with an exact tangent may fail because the tangent is
// indefinite. Where cells are well shaped, it alone changes nothing; but when
// such solves that did converge have wasted as much as a factorisation costs,
// the frozen matrix is factorised.
TEST(AutomaticDecisions, SlowTangentsOfWellShapedBodies)
{
  Case                    c("1, 1, 0.25", thin_cells, 2, "automatic");
  const Vector           &displacement = c.displacement();
  AutomaticPreconditioner P(slow_multigrid());
  P.build(c.A, displacement);
  const unsigned int patience = P.patience(true, false);
  EXPECT_LT(patience, 1000u);
  EXPECT_GT(P.patience(true, true), 1000000u);
  EXPECT_EQ(P.cost(), 1);
  EXPECT_FALSE(P.take_note(2 * patience, true));
  EXPECT_EQ(P.patience(true, true), 30u);
  Vector u(c.body.state.u);
  for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
    u.local_element(i) = 1e-2 * std::sin(1. + i);
  TangentOperator J(c.A, c.body.elasticity, c.body.system.equation().terms);
  J.update({0., u, c.body.state.u}, Tangent::consistent, 1., 0.);
  EXPECT_TRUE(P.change(c.A, &J, displacement, 30, 30));
  EXPECT_GT(P.cost(), 1);
  CholeskyDirect direct;
  direct.build(c.A, displacement);
  Vector expected(c.b), found(c.b);
  direct.vmult(expected, c.b);
  P.vmult(found, c.b);
  EXPECT_EQ(largest_difference(found, expected), 0);
}

TEST(AutomaticDecisions, SlowTangentsOfFlatCells)
{
  Case                    c(thin_size(), thin_cells, 2, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  P.build(c.A, c.displacement());
  EXPECT_EQ(P.patience(true, true), P.patience(true, false));
}

// Factors are not judged by the first solves of a step, which are the hardest,
// unless these take very many iterations.
TEST(AutomaticDecisions, FactorsHaveATrial)
{
  Case                    c(thin_size(), thin_cells, 3, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  make_it_change(P, c);
  const double first = P.patience(false, false);
  EXPECT_FALSE(P.take_note(first, true));
  for (int solve = 0; solve < 20; ++solve)
    EXPECT_FALSE(P.take_note(4, false)) << solve;
  AutomaticPreconditioner Q(slow_multigrid());
  make_it_change(Q, c);
  EXPECT_TRUE(Q.take_note(10000, true));
}

// A solve with old factors gets new ones when it has cost as much as a
// factorisation.
TEST(AutomaticDecisions, OldFactorsAreMadeAnew)
{
  Case                    c(thin_size(), thin_cells, 3, "automatic");
  AutomaticPreconditioner P(slow_multigrid());
  make_it_change(P, c);
  EXPECT_FALSE(P.take_note(2, true));
  const unsigned int patience = P.patience(false, false);
  EXPECT_GT(patience, 10u);
  EXPECT_LT(patience, 100u);
  EXPECT_TRUE(P.change(c.A, nullptr, c.displacement(), patience, patience));
  EXPECT_GT(P.patience(true, false), 1000000u);
}

// After a restart from a checkpoint, decisions and the kind of preconditioner
// are the same.
TEST(AutomaticDecisions, Restart)
{
  Case                    c(thin_size(), thin_cells, 2, "automatic");
  const Vector           &displacement = c.displacement();
  AutomaticPreconditioner before(slow_multigrid()), after(slow_multigrid()),
    changed(slow_multigrid());
  before.build(c.A, displacement);
  before.take_note(before.patience(true, false) / 2, true);
  MemoryArchive archive;
  before.transfer(archive);
  archive.reading = true;
  after.transfer(archive);
  after.build(c.A, displacement);
  EXPECT_EQ(after.patience(true, false), before.patience(true, false));

  make_it_change(before, c);
  MemoryArchive second;
  before.transfer(second);
  second.reading = true;
  changed.transfer(second);
  changed.build(c.A, displacement);
  Vector expected(c.b), found(c.b);
  before.vmult(expected, c.b);
  changed.vmult(found, c.b);
  EXPECT_EQ(largest_difference(found, expected), 0);
}
