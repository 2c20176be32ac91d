// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Parts that are built where Trilinos has Epetra, ML and Amesos: Epetra's view
// of a matrix, and the solvers that need it.

#include <corotet/solvers/epetra/epetra_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../preconditioner_names.h"
#include "../solved_beam.h"
#include "../spring_box.h"

using namespace corotet;
using namespace corotet::tests;

TEST(EpetraMatrix, SolversAreRegistered)
{
  EXPECT_TRUE(has_preconditioner("amg"));
  EXPECT_TRUE(has_preconditioner("direct"));
}

// The view has the same entries, so its products differ only by the order of
// sums; new values are seen at once, without another set-up.
TEST(EpetraMatrix, ShowsTheMatrix)
{
  SpringBox          box({{7, 3, 4}}, true);
  const EpetraMatrix epetra(*box.matrix);
  EXPECT_TRUE(epetra.shows(*box.matrix));
  EXPECT_EQ(epetra.get().NumGlobalRows(), 3 * box.pattern->nodes().n_global());
  EXPECT_EQ(epetra.get().NumMyNonzeros(),
            static_cast<int>(box.matrix->n_values()));
  Vector x = box.vector(), y(x), z(x);
  for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
    x.local_element(i) = std::sin(1. + box.owned.nth_index_in_set(i));
  for (const double mass : {0., 10.})
    {
      box.add_mass(mass);
      box.matrix->vmult(y, x);
      epetra.vmult(z, x);
      EXPECT_GT(y.linfty_norm(), mass / 2 + 1);
      // The round-off of sums of 81 products below 20.
      EXPECT_LE(largest_difference(y, z), 1e-13);
    }
  const SpringBox other({{7, 3, 4}}, true);
  EXPECT_FALSE(epetra.shows(*other.matrix));
}

// The coarse solver "amg" of p-multigrid has the parameters of section amg. At
// degree 1 it is all of p-multigrid, so the solution is that of "Type = amg" to
// the last bit, for every parameter; more sweeps save iterations, also as the
// coarse solver for degree 2.
TEST(AMG, CoarseSolverHasItsParameters)
{
  // The mesh has more unknowns than the coarsest level may have.
  const std::string cells = "20, 6, 6";
  const auto amg = [](const unsigned int sweeps, const double threshold) {
    return section("amg",
                   {{"Smoother sweeps", sweeps},
                    {"Aggregation threshold", threshold}});
  };
  const auto solve_within = [&](const unsigned int degree,
                                const unsigned int sweeps,
                                const double       threshold) {
    return solve_beam(cells,
                      degree,
                      {{"Type", "p-multigrid"},
                       section("p-multigrid", {{"Coarse solver", "amg"}}),
                       amg(sweeps, threshold)});
  };
  for (const unsigned int sweeps : {1, 2, 8})
    for (const double threshold : {1e-4, 0.05})
      {
        const Solved by_itself =
          solve_beam(cells, 1, {{"Type", "amg"}, amg(sweeps, threshold)});
        const Solved coarse = solve_within(1, sweeps, threshold);
        EXPECT_EQ(coarse.iterations, by_itself.iterations);
        EXPECT_EQ(coarse.x, by_itself.x) << sweeps << ' ' << threshold;
      }
  for (const unsigned int degree : {1u, 2u})
    {
      const unsigned int few  = solve_within(degree, 1, 1e-4).iterations;
      const unsigned int many = solve_within(degree, 8, 1e-4).iterations;
      report("iterations with 1 sweep", few);
      report("iterations with 8 sweeps", many);
      EXPECT_GT(few, many) << degree;
    }
}
