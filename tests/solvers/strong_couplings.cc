// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Degree 1 on flat and on stretched cells: aggregates of strongly coupled nodes
// keep iterations few, with two levels, and p-multigrid uses them by itself.

#include <corotet/solvers/p_multigrid.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "clamped_body.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  struct Cycle
  {
    void
    vmult(Vector &dst, const Vector &src) const
    {
      aggregation.vmult(dst.begin(), src.begin(), src.l2_norm());
    }

    SmoothedAggregation aggregation;
  };

  unsigned int
  iterations_of_aggregation(const ClampedBody &body, const double threshold)
  {
    Cycle cycle;
    cycle.aggregation.set_coarsening({.least_similarity = threshold});
    cycle.aggregation.build(body.A.matrix(), body.positions().begin());
    return iterations(body, cycle);
  }

  unsigned int
  iterations_of_multigrid(const ClampedBody &body)
  {
    PMultigrid               multigrid;
    dealii::ParameterHandler prm;
    multigrid.declare_parameters(prm);
    prm.set("Coarse solver", "aggregation");
    multigrid.build(body.A, body.displacement());
    return iterations(body, multigrid);
  }
} // namespace

struct Proportions
{
  const char *name, *size, *cells;
  // The measured numbers of iterations on one, two and three ranks, plus a
  // quarter. Aggregates end at the border of a rank, also if it separates nodes
  // that are coupled strongly.
  std::array<unsigned int, 3> most;
};

class StrongCouplings : public testing::TestWithParam<Proportions>
{};

TEST_P(StrongCouplings, IterationsStayFew)
{
  const ClampedBody  body(GetParam().size, GetParam().cells, element_text(1));
  const unsigned int alike = iterations_of_aggregation(body, 0.3);
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  report(GetParam().name, alike);
  EXPECT_LE(alike, GetParam().most[std::min(n_ranks, 3u) - 1]);
  EXPECT_GT(iterations_of_aggregation(body, 0), 2 * alike);
  EXPECT_EQ(iterations_of_multigrid(body), alike);
}

INSTANTIATE_TEST_SUITE_P(
  All,
  StrongCouplings,
  testing::Values(
    Proportions{"flat by 10", "1, 1, 0.1", "8, 8, 8", {{12, 15, 14}}},
    Proportions{"flat by 100", "1, 1, 0.01", "8, 8, 8", {{14, 19, 45}}},
    Proportions{"stretched by 10", "10, 1, 1", "8, 8, 8", {{10, 10, 12}}},
    Proportions{"stretched by 100", "100, 1, 1", "8, 8, 8", {{12, 12, 14}}}),
  [](const auto &info) {
    std::string name = info.param.name;
    std::erase(name, ' ');
    return name;
  });

// On cubes they save no iterations and cost more: p-multigrid does without.
TEST(StrongCouplingsOfCubes, AreNotAskedFor)
{
  const ClampedBody body("2, 1, 1", "8, 4, 4", element_text(1));
  EXPECT_LE(iterations_of_aggregation(body, 0.3),
            iterations_of_aggregation(body, 0));
  EXPECT_EQ(iterations_of_multigrid(body), iterations_of_aggregation(body, 0));
}
