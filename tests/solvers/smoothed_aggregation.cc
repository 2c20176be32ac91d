// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// One cycle is symmetric, leads conjugate gradients to the solution in a number
// of iterations that hardly grows with the body or with the number of ranks,
// and needs the right rigid body motions for that.

#include <corotet/base/exceptions.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "../body.h"
#include "spring_box.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  /// The number of iterations of conjugate gradients for K x = b until the
  /// residual is 1e-8 |b|; 1000 if it is not reached.
  int
  iterations(const SpringBox &box, const SmoothedAggregation &preconditioner)
  {
    Vector x = box.vector(), r(x), z(x), d(x), q(x);
    for (unsigned int i = 1; i < r.locally_owned_size(); i += 3)
      r.local_element(i) = 1;
    const double b_norm = r.l2_norm();
    double       rz     = 0;
    for (int i = 1; i < 1000; ++i)
      {
        preconditioner.vmult(z.begin(), r.begin(), r.l2_norm());
        const double last = rz;
        rz                = r * z;
        d.sadd(i == 1 ? 0. : rz / last, 1., z);
        box.matrix->vmult(q, d);
        const double step = rz / (d * q);
        x.add(step, d);
        r.add(-step, q);
        if (r.l2_norm() <= 1e-8 * b_norm)
          return i;
      }
    return 1000;
  }
} // namespace

// Aggregates end at the border of a rank, but their smoothed motions reach
// beyond it: if these ended there, too, each rank would cost up to two
// iterations more.
TEST(SmoothedAggregation, IterationsHardlyGrow)
{
  for (const int n : {4, 8, 14})
    {
      const auto iterations_of = [&](const MPI_Comm comm) {
        const SpringBox     box({{4 * n, n, n}}, true, comm);
        SmoothedAggregation preconditioner;
        preconditioner.build(*box.matrix, box.positions().data());
        EXPECT_LT(8 * preconditioner.n_aggregates().front(),
                  box.pattern->nodes().n_global())
          << n;
        return iterations(box, preconditioner);
      };
      const int alone = iterations_of(MPI_COMM_SELF);
      EXPECT_LE(alone, 25) << n;
      const int together = iterations_of(MPI_COMM_WORLD);
      report("iterations on one rank", alone);
      report("iterations on all", together);
      EXPECT_LE(together, alone + 2) << n;
    }
}

// Aggregates are aggregated again until the last level is small; rigid motions
// are in all levels.
TEST(SmoothedAggregation, MoreLevels)
{
  const SpringBox     box({{60, 15, 15}}, true);
  SmoothedAggregation preconditioner;
  preconditioner.set_coarsening({.most_aggregates = 4000});
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_EQ(preconditioner.n_aggregates().size(), 1u);
  const int by_two = iterations(box, preconditioner);
  for (const int most : {330, 100, 10})
    {
      SmoothedAggregation with_more;
      with_more.set_coarsening({.most_aggregates = most});
      with_more.build(*box.matrix, box.positions().data());
      const std::vector<int> n = with_more.n_aggregates();
      EXPECT_GE(n.size(), 2u);
      EXPECT_EQ(n.front(), preconditioner.n_aggregates().front());
      EXPECT_LE(n.back(), most);
      EXPECT_GT(n[n.size() - 2], most);
      // More levels take one iteration more, on one rank and on two.
      EXPECT_LE(iterations(box, with_more), by_two + 3) << most;
    }
}

// Joining three aggregates gives nearly a third as many, for some more
// iterations (15 instead of 9; one more or less is round-off). Aggregates are
// joined only if there are more than the last level may have.
TEST(SmoothedAggregation, JoinedAggregates)
{
  const SpringBox     box({{60, 15, 15}}, true);
  SmoothedAggregation preconditioner, with_fewer;
  preconditioner.build(*box.matrix, box.positions().data());
  with_fewer.set_coarsening({.n_joined = 3});
  with_fewer.build(*box.matrix, box.positions().data());
  // Some aggregates find no free neighbour to be joined with.
  EXPECT_LT(2.5 * with_fewer.n_aggregates().front(),
            preconditioner.n_aggregates().front());
  EXPECT_LE(iterations(box, with_fewer), iterations(box, preconditioner) + 8);
  const SpringBox     small({{20, 5, 5}}, true);
  SmoothedAggregation of_small, joined_of_small;
  of_small.build(*small.matrix, small.positions().data());
  joined_of_small.set_coarsening({.n_joined = 3});
  joined_of_small.build(*small.matrix, small.positions().data());
  EXPECT_EQ(of_small.n_aggregates(), joined_of_small.n_aggregates());
}

// A chain of four aggregates of two nodes each. In pairs, the first is joined
// with the second, and the third with the fourth; by threes, the fourth is left
// alone. In the star, the neighbour with two links is joined first.
TEST(NodeGraph, JoinsClosestNeighbours)
{
  NodeGraph chain;
  for (int i = 0; i < 8; ++i)
    {
      for (int j = std::max(i - 1, 0); j <= i + 1; ++j)
        chain.columns.push_back(j);
      chain.starts.push_back(chain.columns.size());
    }
  const std::vector<int> twos{0, 0, 1, 1, 2, 2, 3, 3};
  EXPECT_EQ(join(chain, twos, 1), twos);
  EXPECT_EQ(join(chain, twos, 2), (std::vector<int>{0, 0, 0, 0, 1, 1, 1, 1}));
  EXPECT_EQ(join(chain, twos, 3), (std::vector<int>{0, 0, 0, 0, 0, 0, 1, 1}));
  EXPECT_EQ(join(NodeGraph(), {}, 3), std::vector<int>());

  NodeGraph star;
  star.columns = {0, 1, 2, 3, 1, 0, 2, 0, 3, 0};
  star.starts  = {0, 4, 6, 8, 10};
  EXPECT_EQ(join(star, {0, 1, 2, 2}, 2), (std::vector<int>{0, 1, 0, 0}));
}

// There are three nodes in a row, and the first of several ranks owns none.
TEST(SmoothedAggregation, AllowsRankWithoutNodes)
{
  SpringBox box({{2, 0, 0}}, false);
  box.add_mass(1.);
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1 &&
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      EXPECT_EQ(box.pattern->n_owned(), 0);
    }
  SmoothedAggregation preconditioner;
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 9);
}

// With equal positions of all nodes there are no rotations.
TEST(SmoothedAggregation, NeedsRotations)
{
  const SpringBox     box({{32, 6, 6}}, true);
  SmoothedAggregation preconditioner;
  preconditioner.build(*box.matrix, box.positions().data());
  const int                 right = iterations(box, preconditioner);
  const std::vector<double> nowhere(std::size_t(3) * box.pattern->n_owned(),
                                    1.);
  preconditioner.build(*box.matrix, nowhere.data());
  EXPECT_GT(iterations(box, preconditioner), 1.5 * right);
}

// Nodes without neighbours stay alone on every level; the coarsening must end
// nevertheless.
TEST(SmoothedAggregation, NodesWithoutNeighbours)
{
  SpringBox box({{40, 0, 0}}, false);
  box.matrix->set_zero();
  box.add_mass(2.);
  SmoothedAggregation preconditioner;
  preconditioner.set_coarsening({.most_aggregates = 5});
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 2);
}

// Memory of the matrix is given back while the levels are built; the mesh is
// large enough for that.
TEST(SmoothedAggregation, MatrixMayBeGivenUp)
{
  const SpringBox     box({{30, 12, 12}}, true);
  SmoothedAggregation keeping, taking;
  keeping.build(*box.matrix, box.positions().data());
  EXPECT_GT(box.matrix->n_values(), 0u);
  taking.build(std::move(*box.matrix), box.positions().data());
  EXPECT_EQ(box.matrix->n_values(), 0u);
  Vector b = box.vector(), x(b), other(b);
  for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
    b.local_element(i) = std::sin(box.owned.nth_index_in_set(i) + 1.);
  keeping.vmult(x.begin(), b.begin(), 1);
  taking.vmult(other.begin(), b.begin(), 1);
  EXPECT_GT(x.l2_norm(), 0.);
  other -= x;
  EXPECT_EQ(other.l2_norm(), 0.);
}

// The operator is symmetric, u.Pv = v.Pu, up to the round-off of single
// precision, for vectors of both precisions.
class Symmetry : public testing::TestWithParam<double>
{};

TEST_P(Symmetry, OfThreeLevels)
{
  SpringBox           box({{9, 5, 4}}, true);
  SmoothedAggregation preconditioner(3);
  preconditioner.set_coarsening(
    {.least_similarity = GetParam(), .most_aggregates = 8});
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_GE(preconditioner.n_aggregates().size(), 2u);
  Vector             u = box.vector(), v(u), Pu(u), Pv(u), widened(u);
  const unsigned int n = u.locally_owned_size();
  std::vector<float> single_v(n), single_Pv(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      const double row   = box.owned.nth_index_in_set(i);
      u.local_element(i) = std::sin(row + 1.);
      v.local_element(i) = std::cos(0.3 * row);
      single_v[i]        = v.local_element(i);
    }
  preconditioner.vmult(Pu.begin(), u.begin(), 1);
  preconditioner.vmult(Pv.begin(), v.begin(), 1);
  preconditioner.vmult(single_Pv.data(), single_v.data(), 1);
  std::copy(single_Pv.begin(), single_Pv.end(), widened.begin());
  const double uPv = u * Pv, vPu = v * Pu, u_single_Pv = u * widened;
  const double uPu = u * Pu, vPv = v * Pv;
  EXPECT_GT(uPu, 0.);
  EXPECT_GT(vPv, 0.);
  const double size = std::sqrt(uPu * vPv);
  EXPECT_NEAR(uPv, vPu, 1e-4 * size);
  EXPECT_NEAR(u_single_Pv, uPv, 1e-4 * size);
}

// The two cases are blocks of points and blocks of aggregates.
INSTANTIATE_TEST_SUITE_P(SmoothedAggregation,
                         Symmetry,
                         testing::Values(0., 0.3),
                         [](const auto &info) {
                           return info.param == 0 ? "Points" : "Aggregates";
                         });

// A free body is refused; with mass the matrix, of the same pattern, is
// definite, and new values are used.
TEST(SmoothedAggregation, FollowsMatrixAndRefusesFreeBody)
{
  SpringBox           box({{8, 4, 4}}, false);
  SmoothedAggregation preconditioner;
  EXPECT_THROW(preconditioner.build(*box.matrix, box.positions().data()),
               ComputationError);
  box.add_mass(1.);
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 20);
  box.add_mass(1e3);
  preconditioner.build(*box.matrix, box.positions().data());
  EXPECT_LE(iterations(box, preconditioner), 8);
}
