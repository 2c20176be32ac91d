// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Bodies on springs and dashpots: statics, motion, modes, stable steps and the
// energy budget.

#include <corotet/time_integration/load_stepping.h>
#include <corotet/time_integration/time_integrators.h>

#include <deal.II/base/numbers.h>

#include <gtest/gtest.h>

#include <cmath>

#include "../integrators.h"
#include "../refusal.h"
#include "complete_run.h"
#include "modal.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Tensor;
using dealii::numbers::PI;

namespace
{
  // A box of E, nu = 0, rho = 1 with tight tolerances.
  std::string
  box_text(const std::string &size,
           const std::string &cells,
           const double       youngs_modulus,
           const std::string &type = "linear")
  {
    return fmt::format(R"(
      subsection Mesh
        subsection box
          set Size  = {}
          set Cells = {}
        end
      end
      subsection Material
        set Type            = {}
        set Young's modulus = {}
        set Poisson's ratio = 0
        set Density         = 1
      end
      subsection Newton
        set Residual tolerance  = 1e-12
        set Increment tolerance = 1e-12
      end
      subsection Linear solver
        set Tolerance = 1e-13
      end
    )",
                       size,
                       cells,
                       type,
                       youngs_modulus);
  }

  std::string
  supports(const std::string &elastic,
           const std::string &normal   = "",
           const std::string &dashpots = "")
  {
    return fmt::format("subsection Supports\n set Elastic = {}\n set Elastic "
                       "normal = {}\n set Dashpots = {}\nend\n",
                       elastic,
                       normal,
                       dashpots);
  }

  std::string
  loads(const std::string &gravity)
  {
    return "subsection Loads\n set Gravity = " + gravity + "\nend\n";
  }

  std::string
  time_integration(const std::string &type,
                   const double       end,
                   const double       step,
                   const std::string &more = "")
  {
    return fmt::format("subsection Time integration\n set Type = {}\n set End "
                       "time = {}\n set Time step = {}\n{}\nend\n",
                       type,
                       end,
                       step,
                       more);
  }

  const std::string statics =
    "subsection Time integration\n set Type = static\nend\n";

  const StepRecord &
  last_record(const CompleteRun &run)
  {
    return run.recorder().records.back();
  }

  // Mean displacement over the nodes; all move alike in these tests.
  double
  mean_displacement(const CompleteRun &run, const unsigned int component)
  {
    const Vector &u   = run.recorder().displacement;
    double        sum = 0;
    for (unsigned int i = component; i < u.locally_owned_size(); i += 3)
      sum += u.local_element(i);
    return dealii::Utilities::MPI::sum(sum, u.get_mpi_communicator()) /
           (u.size() / 3);
  }
} // namespace

// A block of 2 kg on springs of 8 N/m^3 under its weight, 10 m/s^2: along x, y,
// z the springs give by m g / (k A), of 1 m^2. Without lateral contraction only
// z deforms the block, by g z (H - z / 2) rho / E, which with E = 1e9 is 2e-8 of
// it; across, shear does by as much. Elements of all kinds, both materials.
TEST(ElasticSupports, BlockSinks)
{
  for (const std::string element :
       {"set Degree = 1",
        "set Degree = 2",
        "set Degree = 3",
        "set Degree = 2\n set Mass = nodal quadrature"})
    for (const std::string type : {"linear", "corotational"})
      {
        // Corotational: no moments, which would turn the block.
        const bool  is_linear = type == "linear";
        CompleteRun run(box_text("1, 1, 2", "1, 2, 2", 1e9, type) +
                        "subsection Discretization\n " + element + "\nend\n" +
                        supports("z-min: 4; 5; 8") +
                        loads(is_linear ? "0; 0; -10" : "0; 0; -0.1") +
                        statics);
        ASSERT_EQ(run.run(), "");
        const double expected = is_linear ? -2.5 : -0.025;
        EXPECT_NEAR(mean_displacement(run, 2), expected, 1e-7);
        const StepRecord &record = last_record(run);
        // Half of the work of the weight, all of it in the springs.
        EXPECT_NEAR(record.elastic_energy, 4 * expected * expected, 1e-6);
        EXPECT_NEAR(record.energy_balance, 0, 1e-9 * record.elastic_energy);
        if (is_linear)
          {
            EXPECT_EQ(record.newton_iterations, 1u);
          }
      }
}

// Statics knows what springs hold, and says what they do not.
TEST(ElasticSupports, RigidMotions)
{
  const auto refusal_of = [](const std::string &text) {
    return refusal([&] {
      CompleteRun run(box_text("1, 1, 1", "2, 2, 2", 1.) + text + statics);
    });
  };
  const std::string begin =
    "Boundary conditions/Fixed: statics needs a body that cannot move without "
    "strain; found: the body can ";
  const std::string end =
    "; allowed: Fixed, Displacement and Supports such that nothing of this is "
    "left, or another Time integration/Type";
  const std::string nothing = "nothing was refused";
  EXPECT_EQ(refusal_of(supports("z-min: 1e-3; 1; 1e3")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1, x-min: 1, y-min: 1")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1")),
            begin +
              "move along x and y and rotate about the axis through (0.5, "
              "0.5, 0.5) along z" +
              end);
  EXPECT_EQ(refusal_of(supports("z-min: 0; 0; 1", "x-max: 2")),
            begin + "move along y" + end);
  // Springs where x > 1/2 only hold it as those of the whole side do.
  EXPECT_EQ(refusal_of(supports("z-min: 1; 1; if(x > 0.5, 1, 0)")), nothing);
  EXPECT_EQ(refusal_of(supports("", "z-min: 1") +
                       "subsection Boundary conditions\n set Displacement = "
                       "x-min: 0; 0; free\nend\n"),
            nothing);
  // Dashpots hold nothing.
  EXPECT_EQ(refusal_of(supports("", "", "z-min: 1; 1; 1")),
            begin + "move in any direction and rotate about any axis" + end);
}

// A support that is k times stiffer gives by 1/k of it: the difference to the
// fixed bar, pulled by 1 Pa, is 1/k at its end, exactly.
TEST(ElasticSupports, StiffSpringsFix)
{
  const std::string text = box_text("2, 1, 1", "4, 2, 2", 1.) +
                           "subsection Boundary conditions\n set Traction = "
                           "x-max: 1; 0; 0\n";
  for (const double k : {1e2, 1e4, 1e6})
    {
      CompleteRun run(text + "end\n" +
                      supports(fmt::format("x-min: {0}; {0}; {0}", k)) +
                      statics);
      ASSERT_EQ(run.run(), "");
      // Without springs: the mean of x / E is 1 m.
      CompleteRun fixed(text + "set Fixed = x-min\nend\n" + statics);
      ASSERT_EQ(fixed.run(), "");
      EXPECT_NEAR(mean_displacement(run, 0) - mean_displacement(fixed, 0),
                  1 / k,
                  1e-11);
    }
}

// The iterations of p-multigrid with springs from soft to stiff, 1e9 E / L, are
// about those of the fixed body, whatever the element; each solve is the one of
// a linear problem. Those of the other preconditioners, too.
TEST(ElasticSupports, StiffSpringsDoNotStall)
{
  struct Case
  {
    std::string text;
    std::string type = "p-multigrid";
  };
  for (const Case &c :
       {Case{"set Degree = 1"},
        Case{"set Degree = 2"},
        Case{"set Degree = 3"},
        Case{"set Degree = 2\n set Mass = nodal quadrature"},
        Case{"set Degree = 2", "amg"},
        Case{"set Degree = 2", "direct\n set Operator = assembled"}})
    {
      const std::string text =
        box_text("4, 1, 1", "8, 2, 2", 1e6) +
        "subsection Linear solver\n set Tolerance = 1e-8\n set Type = " +
        c.type + "\nend\nsubsection Newton\n set Residual tolerance = 1e-8\nend\n"
                 "subsection Discretization\n " +
        c.text +
        "\nend\nsubsection Boundary conditions\n set Traction = x-max: 1e3; "
        "200; 100\n";
      CompleteRun fixed(text + "set Fixed = x-min\nend\n" + statics);
      ASSERT_EQ(fixed.run(), "");
      const unsigned int n = last_record(fixed).linear_iterations;
      unsigned int       most = 0;
      for (const double k : {1e2, 1e5, 1e8, 1e11, 1e14})
        {
          CompleteRun run(text + "end\n" +
                          supports(fmt::format("x-min: {0}; {0}; {0}", k)) +
                          statics);
          ASSERT_EQ(run.run(), "");
          EXPECT_EQ(last_record(run).newton_iterations, 1u);
          most = std::max(most, last_record(run).linear_iterations);
        }
      report(c.text + ", " + c.type + ": iterations when fixed", n);
      report("  with springs, at most", most);
      EXPECT_LE(most, n + n / 2 + 4);
    }
}

// The same where the surfaces' normals are no axes: springs normal to three
// sides of a block that is turned, which leave the sides free along them.
TEST(ElasticSupports, StiffNormalSpringsDoNotStall)
{
  for (const unsigned int degree : {1, 2, 3})
    for (const double k : {1., 1e3, 1e6, 1e9})
      {
        SerialMesh mesh = box("1, 1, 1", "4, 4, 4", 0.1);
        const auto R    = rotation_about(Tensor<1, 3>({1, 2, 3}), 0.7);
        for (auto &x : mesh.vertices)
          x = dealii::Point<3>(R * x);
        Body body(mesh,
                  fmt::format("subsection Discretization\n set Degree = "
                              "{}\nend\nsubsection Material\n set Type = "
                              "linear\n set Young's modulus = 1\nend\n",
                              degree) +
                    supports("",
                             fmt::format("x-min: {0}, y-min: {0}, z-min: {0}",
                                         k)) +
                    "subsection Boundary conditions\n set Traction = x-max: "
                    "1; 2; -1\nend\n");
        LoadStepping      integrator;
        const StageReport stage =
          integrator.step(body.system, {0., 1., 1.}, body.state);
        EXPECT_EQ(stage.newton_iterations, 1u);
        EXPECT_LE(stage.linear_iterations, 18u);
        report(fmt::format("degree {}, k = {:g}: iterations", degree, k),
               stage.linear_iterations);
      }
}

// Modes of a bar along z with springs at its lower end: omega tan(omega L / c)
// = k c / E, and waves across in the same way with the shear modulus E / 2
// (nu = 0; but for the bar's rocking, which the square bar's high springs
// leave: those are other modes). Eight cubic elements know the lowest mode to
// 1e-9. With k L / E << 1 it is that of a rigid block, sqrt(k / (rho L)), times
// 1 - k L / (6 E) to first order.
TEST(ElasticSupports, BarOnASpring)
{
  for (const double k : {1e-4, 1., 30.})
    {
      double lower = 0, upper = PI / 2;
      for (unsigned int i = 0; i < 100; ++i)
        {
          const double middle = 0.5 * (lower + upper);
          (middle * std::tan(middle) < k ? lower : upper) = middle;
        }
      Analysis    body(box_body("0.2, 0.2, 1",
                             "1, 1, 8",
                             3,
                             0.,
                             6,
                             supports(fmt::format("z-min: {0}; {0}; {1}",
                                                  1e6,
                                                  k))));
      const Mode *found = nullptr;
      for (unsigned int i = 6; i > 0; --i)
        if (body.mode(i).effective_mass[2] > 0.5 * 0.04)
          found = &body.mode(i);
      ASSERT_NE(found, nullptr);
      EXPECT_NEAR(found->angular_frequency / lower, 1, 1e-7);
      if (k < 1e-3)
        {
          EXPECT_NEAR(found->angular_frequency / std::sqrt(k),
                      1 - k / 6,
                      k * k);
        }
    }
}

// A free block on springs has no rigid body modes: the lowest three are its
// translations, on equal springs all around, with sqrt(k_sum / m).
TEST(ElasticSupports, BlockOnSoftSprings)
{
  const double k = 1e-5;
  Analysis body(
    box_body("1, 1, 1",
             "2, 2, 2",
             2,
             0.3,
             7,
             supports(fmt::format("x-min: {0}; {0}; {0}, x-max: {0}; {0}; {0}",
                                  k))));
  // The block gives by some k L / E of it.
  for (unsigned int i = 1; i <= 3; ++i)
    EXPECT_NEAR(body.mode(i).angular_frequency / std::sqrt(2 * k), 1, 2 * k);
  for (unsigned int i = 4; i <= 6; ++i)
    EXPECT_GT(body.mode(i).angular_frequency, std::sqrt(k));
  EXPECT_GT(body.mode(7).angular_frequency, 1);
}

// The stable step knows the springs: with those that are far stiffer than the
// body the largest frequency grows as sqrt(k).
TEST(ElasticSupports, StableStep)
{
  double omega[2];
  for (const unsigned int i : {0, 1})
    {
      Body body(box("1, 1, 1", "2, 2, 2"),
                "subsection Discretization\n set Degree = 2\n set Mass = nodal "
                "quadrature\nend\nsubsection Material\n set Young's modulus = "
                "1\nend\n" +
                  supports(i == 0 ? "z-min: 1e8; 1e8; 1e8" :
                                    "z-min: 4e8; 4e8; 4e8"));
      omega[i] = body.system.largest_frequency(body.state, 0.);
    }
  EXPECT_NEAR(omega[1] / omega[0], 2, 2e-3);
  EXPECT_GT(omega[0], 1e3);
}

// A stiff block of 1 kg, u = v = 0.1 m at the start on springs of 4 N/m and
// critical dashpots, c = 2 sqrt(k m) = 4 N s/m: u = (u_0 + (v_0 + 2 u_0) t)
// exp(-2 t). The trapezoidal rule's error is some (omega dt)^2 / 12 = 3e-6 of
// it; central difference has half of that, its own dt, and another sign. The
// block gives by 1e-6.
TEST(ElasticSupports, CriticalDamping)
{
  for (const std::string method : {"implicit midpoint", "central difference"})
    {
      const bool  is_explicit = method == "central difference";
      CompleteRun run(
        box_text("1, 1, 1", "1, 1, 1", is_explicit ? 4e3 : 4e6) +
        "subsection Discretization\n set Degree = 2\n set Mass = nodal "
        "quadrature\nend\n" +
        supports("z-min: 4; 4; 4", "", "z-min: 4; 4; 4") +
        "subsection Initial conditions\n set Displacement = 0; 0; 0.1\n set "
        "Velocity = 0; 0; 0.1\nend\n" +
        time_integration(method, 1, is_explicit ? 5e-4 : 2.5e-3));
      ASSERT_EQ(run.run(), "");
      EXPECT_NEAR(mean_displacement(run, 2),
                  (0.1 + 0.3) * std::exp(-2),
                  is_explicit ? 1e-4 : 1e-6);
      const StepRecord &record = last_record(run);
      EXPECT_NEAR(record.energy_balance, 0, 1e-12);
      EXPECT_GT(record.dissipated_energy, 0.01);
    }
}

// A wave f(x - c t) runs along a bar of c = 1 m/s, Z = rho c = 1 N s/m^3, into
// dashpots of R Z: what comes back has the amplitude (Z - c_d) / (Z + c_d), so
// the energy's part is its square. The pulse is sin^4 over a length of 1 m, of
// which cells of 1/24 m know the energy to 1e-4; half a dozen of the wave's
// errors make 1e-3.
TEST(ElasticSupports, DashpotsAbsorbWaves)
{
  for (const std::string method : {"implicit midpoint", "central difference"})
    for (const double damping : {1., 3., 0.5})
      {
        const std::string s = "max(0, min(1, x - 0.5))";
        // u = -int f, v = f for sigma = E u', u' = -f.
        CompleteRun run(
          box_text("2, 0.1, 0.1", "48, 1, 1", 1.) +
          "subsection Discretization\n set Degree = 2\n set Mass = nodal "
          "quadrature\nend\n" +
          supports("", "", fmt::format("x-max: {}; 0; 0", damping)) +
          fmt::format(
            "subsection Initial conditions\n set Displacement = -(3 / 8 * ({0}) "
            "- sin(2 * pi * ({0})) / (4 * pi) + sin(4 * pi * ({0})) / (32 * "
            "pi)); 0; 0\n set Velocity = sin(pi * ({0}))^4; 0; 0\nend\n",
            s) +
          time_integration(method,
                           1.75,
                           method == "central difference" ? 0. : 0.0125));
        ASSERT_EQ(run.run(), "");
        const StepRecord &first  = run.recorder().records.front();
        const StepRecord &record = last_record(run);
        const double      energy = first.kinetic_energy + first.elastic_energy;
        const double      left   = record.kinetic_energy + record.elastic_energy;
        const double      R      = (1 - damping) / (1 + damping);
        EXPECT_NEAR(left / energy, R * R, 1e-3);
        EXPECT_NEAR(record.dissipated_energy / energy, 1 - R * R, 1e-3);
        EXPECT_NEAR(record.energy_balance, 0, 1e-11 * energy);
      }
}

// Budgets close to round-off for all integrators that promise it, with springs
// whose stiffness depends on time, and dashpots; and their energy is part of
// the elastic one. Also beside supports that move.
TEST(ElasticSupports, BudgetCloses)
{
  for (const std::string &name :
       integrators_with([](const TimeIntegrator &integrator) {
         return integrator.closes_budget();
       }))
    for (const std::string k : {"3; 5; 7", "3; 5; 7 * (1.5 + sin(9 * t))"})
      for (const bool moves : {false, true})
        {
          const std::string motion =
            moves ? "subsection Boundary conditions\n set Displacement = "
                    "z-max: free; free; 0.1 * smooth_step(t, 0, 0.5)\nend\n" :
                    "";
          CompleteRun run(box_text("1, 1, 1", "2, 2, 2", 100.) +
                          "subsection Discretization\n set Degree = 2\nend\n" +
                          supports("z-min: " + k + ", z-max: 2; 2; 2",
                                   "x-max: 5",
                                   "y-min: 0.1; 0.2; 0.3 * t, z-max: 1; 1; 1") +
                          loads("1; 2; -10 * cos(4 * t)") + motion +
                          time_integration(name, 1, 0.02));
          ASSERT_EQ(run.run(), "");
          const StepRecord &record = last_record(run);
          const double      energy =
            record.elastic_energy + record.dissipated_energy;
          EXPECT_GT(energy, 0.1);
          EXPECT_NEAR(record.energy_balance, 0, 1e-11 * energy) << name;
        }
}

// A block of 1 kg on springs with k(t) A = 2 / (2 - t^2) N/m: u = 2 - t^2 solves
// u'' = - k u, from rest. What is fed in by the change of k is int k' u^2 / 2 dt
// = t^2 J. The acceleration is constant, so the trapezoidal rule is exact; the
// block gives by k L / E = 2e-7 of it.
TEST(ElasticSupports, StiffnessThatChanges)
{
  CompleteRun run(box_text("1, 1, 1", "1, 1, 1", 1e7) +
                  supports("z-min: 1; 1; 2 / (2 - t^2)") +
                  "subsection Initial conditions\n set Displacement = 0; 0; "
                  "2\nend\n" +
                  time_integration("Newmark", 1, 0.05));
  ASSERT_EQ(run.run(), "");
  const StepRecord &record = last_record(run);
  EXPECT_NEAR(mean_displacement(run, 2), 1, 2e-7);
  EXPECT_NEAR(record.external_work, 1, 2e-7);
  EXPECT_NEAR(record.elastic_energy, 1, 4e-7);
  EXPECT_NEAR(record.kinetic_energy, 2, 4e-7);
}

// Values that become wrong end the run with the place and the time.
TEST(ElasticSupports, StiffnessThatBecomesNegative)
{
  CompleteRun       run(box_text("1, 1, 1", "1, 1, 1", 10.) +
                  supports("z-min: 1; 1; 1 - 2 * t") +
                  time_integration("implicit midpoint", 1, 0.1));
  const std::string message = run.run();
  EXPECT_NE(message.find("Supports/Elastic: found the value -"),
            std::string::npos)
    << message;
}

// Explicit and implicit steps agree in the limit: differences fall with dt^2,
// with corotational elasticity and large motion.
TEST(ElasticSupports, ExplicitAndImplicitSteps)
{
  double difference[2];
  for (const unsigned int i : {0, 1})
    {
      double u[2];
      for (const bool is_explicit : {false, true})
        {
          CompleteRun run(
            box_text("1, 1, 1", "2, 1, 1", 100., "corotational") +
            "subsection Discretization\n set Degree = 2\n set Mass = nodal "
            "quadrature\nend\n" +
            supports("x-min: 20; 30; 40", "", "x-min: 1; 1; 2") +
            loads("0; 0; -3") +
            time_integration(is_explicit ? "central difference" :
                                           "implicit midpoint",
                             1,
                             i == 0 ? 0.004 : 0.002));
          ASSERT_EQ(run.run(), "");
          u[is_explicit] = mean_displacement(run, 2);
        }
      difference[i] = std::abs(u[1] - u[0]);
      EXPECT_GT(std::abs(u[0]), 0.1);
    }
  EXPECT_LT(difference[0], 1e-4);
  EXPECT_NEAR(difference[0] / difference[1], 4, 0.6);
}
