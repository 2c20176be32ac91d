// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// No mode is missing, and the reported properties of modes are right.

#include <deal.II/lac/lapack_full_matrix.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../refusal.h"
#include "../temporary_folder.h"
#include "modal.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // All eigenvalues of a body, from full matrices: built column by column with
  // unit vectors, without rows and columns of prescribed unknowns.
  std::vector<double>
  all_eigenvalues(const SerialMesh &mesh, const std::string &text)
  {
    const MovingBody      body(mesh, text + material_type("linear"));
    const Discretization &disc       = body.discretization;
    const unsigned int    n          = 3 * disc.n_global_nodes();
    const auto            gather_row = [&](const Vector &x) {
      std::vector<double> row(n), sum(n);
      for (const auto i : x.locally_owned_elements())
        row[i] = x(i);
      dealii::Utilities::MPI::sum(row, MPI_COMM_WORLD, sum);
      return sum;
    };

    Vector x, f, prescribed;
    for (Vector *vector : {&x, &f, &prescribed})
      disc.initialize_vector(*vector);
    for (const unsigned int i : body.motion.unknowns())
      prescribed.local_element(i) = 1;
    std::vector<unsigned int> free;
    const auto                is_prescribed = gather_row(prescribed);
    for (unsigned int i = 0; i < n; ++i)
      if (is_prescribed[i] == 0)
        free.push_back(i);

    dealii::LAPACKFullMatrix<double> K(free.size()), M(free.size());
    for (unsigned int j = 0; j < free.size(); ++j)
      {
        x = 0;
        if (x.in_local_range(free[j]))
          x(free[j]) = 1;
        x.update_ghost_values();
        body.elasticity.apply_tangent(f, x);
        const auto column_of_K = gather_row(f);
        body.mass.apply(f, x);
        const auto column_of_M = gather_row(f);
        for (unsigned int i = 0; i < free.size(); ++i)
          {
            K(i, j) = column_of_K[free[i]];
            M(i, j) = column_of_M[free[i]];
          }
        x.zero_out_ghost_values();
      }
    std::vector<dealii::Vector<double>> no_vectors;
    K.compute_generalized_eigenvalues_symmetric(M, no_vectors);
    std::vector<double> values;
    for (unsigned int i = 0; i < free.size(); ++i)
      values.push_back(K.eigenvalue(i).real());
    return values;
  }

  void
  expect_all_found(const std::string &cells,
                   const unsigned int degree,
                   const std::string &mass,
                   const std::string &boundaries,
                   const unsigned int n_modes)
  {
    SCOPED_TRACE(
      fmt::format("degree {}, {}, fixed: {}", degree, mass, boundaries));
    const std::string text = box_body("1, 1, 1", cells, degree, 0.3, n_modes) +
                             element_text(degree, mass) + fixed(boundaries);
    const auto     exact = all_eigenvalues(box("1, 1, 1", cells), text);
    const Analysis computed(text);
    for (unsigned int i = 0; i < n_modes; ++i)
      EXPECT_NEAR(computed.mode(i + 1).eigenvalue,
                  exact[i],
                  1e-11 * exact.back());
  }
} // namespace

// The body is a cube: each eigenvalue occurs one, two or three times, that of
// the rigid body modes six times, and none must be missing. Dense linear
// algebra, a backward stable method, gives them up to the round-off of the
// largest one. As many modes are asked for as are allowed, and some numbers
// that end within a group of equal eigenvalues.
TEST(ModalAnalysis, FindsAllEigenvalues)
{
  expect_all_found("2, 2, 2", 1, "consistent", "", 20);
  expect_all_found("2, 2, 2", 1, "consistent", "", 15);
  expect_all_found("2, 2, 2", 1, "consistent", "", 8);
  expect_all_found("2, 2, 2", 1, "row sum", "", 20);
  expect_all_found("2, 2, 2", 2, "consistent", "x-min", 33);
  expect_all_found("1, 1, 1", 2, "diagonal scaling", "", 17);
  expect_all_found("1, 1, 1", 3, "diagonal scaling", "z-max", 11);
}

// A free body has six modes without strain, which carry all of its mass. Their
// frequencies are those of the strain that errors of 1e-11, the tolerance of
// the linear solver, leave in them. The other modes move no mass in total, as
// they are orthogonal to these.
TEST(ModalAnalysis, FreeBody)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      SCOPED_TRACE(degree);
      const Analysis body(box_body("1, 0.3, 0.2", "5, 2, 1", degree, 0.3, 9));
      dealii::Tensor<1, 3> rigid;
      double               largest = 0;
      for (unsigned int i = 1; i <= 6; ++i)
        {
          largest = std::max(largest, body.mode(i).frequency);
          rigid += body.mode(i).effective_mass;
        }
      EXPECT_LT(largest, 1e-10 * body.mode(7).frequency);
      report(fmt::format("frequency of rigid body modes, relative, degree {}",
                         degree),
             largest / body.mode(7).frequency);
      for (unsigned int a = 0; a < 3; ++a)
        {
          EXPECT_NEAR(rigid[a], 0.06, 1e-10);
          for (unsigned int i = 7; i <= 9; ++i)
            EXPECT_NEAR(body.mode(i).effective_mass[a], 0., 1e-15);
        }
    }
}

// Far from the origin, as where coordinates are those of a map, places of nodes
// are rounded to 1e-9 m, and rigid motions have as much strain. The distance is
// a power of two, so the vertices themselves are exact.
TEST(ModalAnalysis, FarFromTheOrigin)
{
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      SCOPED_TRACE(degree);
      const std::string text =
        box_body("1, 0.5, 0.25", "4, 2, 1", degree, 0.3, 8);
      const Analysis near(text);
      const Analysis far(
        text + section("Mesh",
                       {section("box", {{"Origin", "8388608, -8388608, 0"}})}));
      for (unsigned int i = 7; i <= 8; ++i)
        EXPECT_NEAR(far.mode(i).frequency / near.mode(i).frequency, 1, 1e-8);
    }
}

// The reported properties of a mode fit its vector: its residual, evaluated
// here, its amplitude, and zero displacement at the support.
TEST(ModalAnalysis, ShapesSolveTheEquation)
{
  const std::string text =
    box_body("1, 0.3, 0.2", "5, 2, 1", 2, 0.3, 6) + fixed("x-min") +
    displacements("x-max: free; 0.1; free") + material_type("linear");
  const Analysis   computed(text);
  const MovingBody body(box("1, 0.3, 0.2", "5, 2, 1"), text);
  Vector           f(computed.mode(1).shape), g(f), phi(f);
  for (unsigned int i = 1; i <= 6; ++i)
    {
      const Mode &mode = computed.mode(i);
      phi.copy_locally_owned_data_from(mode.shape);
      phi.update_ghost_values();
      body.elasticity.apply_tangent(f, phi);
      body.mass.apply(g, phi);
      EXPECT_NEAR(phi * g, mode.modal_mass, 1e-12 * mode.modal_mass);
      body.motion.set_zero(f);
      body.motion.set_zero(g);
      f.add(-mode.eigenvalue, g);
      // The default tolerance is 1e-8.
      EXPECT_LT(norm(f), 1e-8 * mode.eigenvalue * norm(g));
      for (const unsigned int k : body.motion.unknowns())
        EXPECT_EQ(phi.local_element(k), 0.);
      double square = 0;
      for (unsigned int n = 0; n < body.discretization.n_owned_nodes(); ++n)
        {
          dealii::Tensor<1, 3> u;
          for (unsigned int a = 0; a < 3; ++a)
            u[a] = phi.local_element(3 * n + a);
          square = std::max(square, u.norm_square());
        }
      square = dealii::Utilities::MPI::max(square, MPI_COMM_WORLD);
      EXPECT_NEAR(std::sqrt(square), 0.01 * std::sqrt(1.13), 1e-12);
    }
}

// A cube has groups of equal frequencies, here the seventh mode and some that
// follow. A remark tells if such a group is cut.
TEST(ModalAnalysis, SaysThatAGroupIsCut)
{
  const auto text = [](const unsigned int n_modes) {
    return box_body("1, 1, 1", "2, 2, 2", 2, 0.3, n_modes);
  };
  const Analysis all(text(20));
  unsigned int   n = 7;
  while (all.mode(n + 1).frequency < (1 + 1e-8) * all.mode(n).frequency)
    ++n;
  EXPECT_GT(n, 7u);
  // Other frequencies must be clearly different.
  EXPECT_GT(all.mode(n + 1).frequency, 1.01 * all.mode(n).frequency);
  for (const unsigned int n_modes : {4u, 6u, 7u, n})
    {
      const TemporaryFolder folder;
      Parameters            parameters(text(n_modes));
      Log                   log(MPI_COMM_WORLD, true);
      log.open(folder / "log.txt");
      ModalAnalysis analysis(parameters, "", MPI_COMM_WORLD, log);
      analysis.compute();
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
        continue;
      const std::string found = folder.read("log.txt");
      const std::string group = fmt::format(
        "Mode 7 belongs to a group of {} modes with equal frequencies (each "
        "within 0.5 % of the next), of which 1 is given; Modes/Number = {} "
        "gives all",
        n - 6,
        n);
      const std::string rigid = "Mode 4 is a rigid body mode, of which 4 of 6 "
                                "are given; Modes/Number = 6 gives all";
      EXPECT_EQ(found.find(group) != std::string::npos, n_modes == 7) << found;
      EXPECT_EQ(found.find(rigid) != std::string::npos, n_modes == 4) << found;
      EXPECT_EQ(found.find("gives all") != std::string::npos,
                n_modes == 4 || n_modes == 7)
        << found;
    }
}

// Frequencies do not depend on the shift, up to the square of the tolerance, or
// round-off. A shift that is far too large is refused, as with it all vectors
// would pass for modes; one that is lost in round-off leaves the matrix of a
// free body singular.
TEST(ModalAnalysis, Shift)
{
  const auto text = [](const double shift) {
    return box_body("1, 0.3, 0.2", "5, 2, 1", 2, 0.3, 9) +
           section("Modes", {{"Shift", shift}});
  };
  const Analysis reference(text(0));
  const double   lowest = reference.mode(7).eigenvalue;
  for (const double factor : {1e-4, 1., 5.})
    {
      const Analysis shifted(text(factor * lowest));
      for (unsigned int i = 7; i <= 9; ++i)
        EXPECT_NEAR(shifted.mode(i).frequency,
                    reference.mode(i).frequency,
                    1e-12 * reference.mode(i).frequency);
    }
  const auto failure = [&](const double shift) -> std::string {
    try
      {
        const Analysis shifted(text(shift));
      }
    catch (const ComputationError &error)
      {
        return error.what();
      }
    return "nothing failed";
  };
  const std::string large = failure(100 * lowest), small = failure(1e-18);
  EXPECT_EQ(large.find("Modes/Shift: found "), 0u) << large;
  EXPECT_NE(large.find(" 1/s^2; allowed: up to "), std::string::npos) << large;
  EXPECT_EQ(small.find("Modes/Shift: found 1e-18 1/s^2, which is too small: "
                       "round-off makes K + s M singular; allowed: a larger "
                       "one, best "),
            0u)
    << small;
  // A shift beyond all modes is refused before anything is computed.
  EXPECT_EQ(refusal([&] {
              const Analysis shifted(text(1e14));
            }).find("Modes/Shift: found 1e+14 1/s^2; allowed: less than "),
            0u);
}

// A body on springs so soft that it moves on them as a rigid body: its other
// modes are those of the free body up to the ratio of the stiffnesses, and the
// suspension has omega^2 = k / m, with the area of the side and the mass 0.06
// kg.
TEST(ModalAnalysis, SoftSprings)
{
  const std::string body = box_body("1, 0.3, 0.2", "5, 2, 1", 2, 0.3, 9);
  const Analysis    free(body);
  for (const double k : {1e-3, 1e-6, 1e-9, 1e-12})
    {
      const Analysis suspended(
        body + section("Supports",
                       {{"Elastic", fmt::format("z-min: {0}; {0}; {0}", k)}}));
      for (unsigned int i = 7; i <= 9; ++i)
        EXPECT_NEAR(suspended.mode(i).frequency,
                    free.mode(i).frequency,
                    (1e2 * k + 1e-11) * free.mode(i).frequency)
          << k;
      // The motion along y is coupled with the rotation about x, that along z
      // is not.
      double nearest = 1;
      for (unsigned int i = 1; i <= 6; ++i)
        nearest =
          std::min(nearest,
                   std::abs(suspended.mode(i).eigenvalue / (k * 0.3 / 0.06) -
                            1));
      EXPECT_LE(nearest, 1e2 * k + 1e-6) << k;
    }
}

// Bending and twisting modes of a beam that is symmetric about its middle
// planes: each has two or more largest components, of both signs. Signs are the
// same on all ranks together and on each rank alone: products of the shapes
// with a field without symmetry agree as well as the shapes do, to the
// tolerance 1e-8 over the relative gaps between frequencies, some 1e-2.
TEST(ModalAnalysis, SignsDoNotDependOnRanks)
{
  const auto products = [](const std::string &boundaries, const MPI_Comm comm) {
    Parameters    parameters(box_body("1, 0.3, 0.2", "6, 2, 2", 2, 0.3, 12) +
                          fixed(boundaries));
    Log           log(comm, true);
    ModalAnalysis analysis(parameters, "", comm, log);
    analysis.compute();
    const Discretization &disc = analysis.body().discretization;
    std::vector<double>   result;
    for (const Mode &mode : analysis.modes())
      {
        double sum = 0, size = 0;
        for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
          for (unsigned int a = 0; a < 3; ++a)
            {
              const dealii::Point<3> x = disc.node_position(n);
              const double           u = mode.shape.local_element(3 * n + a);
              sum +=
                u * std::cos(3.1 * x[0] + 7.3 * x[1] + 5.7 * x[2] + 2. * a);
              size += std::abs(u);
            }
        result.push_back(dealii::Utilities::MPI::sum(sum, comm) /
                         dealii::Utilities::MPI::sum(size, comm));
      }
    return result;
  };
  for (const std::string fixed : {"x-min", ""})
    {
      const auto together = products(fixed, MPI_COMM_WORLD);
      const auto alone    = products(fixed, MPI_COMM_SELF);
      for (unsigned int i = 0; i < 12; ++i)
        {
          EXPECT_GT(std::abs(alone[i]), 1e-4) << i;
          EXPECT_NEAR(together[i], alone[i], 1e-6) << i;
        }
    }
}

TEST(ModalAnalysis, Refusals)
{
  const auto refused = [](const std::string &more) {
    return refusal([&] {
      Parameters parameters(box_body("1, 1, 1", "1, 1, 1", 1, 0.3, 7) + more);
      Log        log(MPI_COMM_WORLD, true);
      ModalAnalysis analysis(parameters, "", MPI_COMM_WORLD, log);
    });
  };
  EXPECT_EQ(
    refused(""),
    "Modes/Number: found 7; allowed: at most 6 with the 24 unknowns that "
    "are not prescribed (a quarter of them; none of fewer than 16)");
  EXPECT_EQ(
    refused(fixed("x-min")),
    "Modes/Number: found 7; the 12 unknowns that are not prescribed are too "
    "few for modes: needed are 16");
}
