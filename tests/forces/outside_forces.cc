// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A force that a program adds: the example in CONTRIBUTING.md.

#include <corotet/forces/force_kind.h>
#include <corotet/time_integration/central_difference.h>
#include <corotet/time_integration/implicit_midpoint.h>

#include <gtest/gtest.h>

#include "../body.h"
#include "../simulation/complete_run.h"

using namespace corotet;
using namespace corotet::tests;
using dealii::Tensor;

namespace
{
  // A force per mass that pulls back to the position at rest, -w^2 u: f = -w^2
  // M u, with the energy w^2 u . M u / 2. K does not contain it, so its
  // derivative is of the kind that belongs neither to elasticity nor to the
  // surface.
  class Pull : public corotet::ForceTerm
  {
  public:
    Pull(const corotet::ForceContext &context, const double w)
      : context(context)
      , factor(w * w)
    {
      context.discretization.initialize_vector(product);
    }

    Role
    role() const override
    {
      return Role::elastic;
    }

    bool
    depends_on_time() const override
    {
      return false;
    }

    bool
    depends_on_displacement() const override
    {
      return true;
    }

    bool
    is_linear() const override
    {
      return true;
    }

    void
    add_force(corotet::Vector &f, const corotet::Motion &motion) const override
    {
      add_linearized(f, motion.u, 0.);
    }

    double
    energy(const corotet::Motion &motion) const override
    {
      context.apply_mass(product, motion.u);
      double sum = 0;
      for (unsigned int i = 0; i < product.locally_owned_size(); ++i)
        sum += product.local_element(i) * motion.u.local_element(i);
      return 0.5 * factor *
             dealii::Utilities::MPI::sum(sum, product.get_mpi_communicator());
    }

    bool
    has_linearization() const override
    {
      return true;
    }

    void
    add_linearized(corotet::Vector       &f,
                   const corotet::Vector &w,
                   const double /*velocity_factor*/) const override
    {
      context.apply_mass(product, w);
      for (unsigned int i = 0; i < f.locally_owned_size(); ++i)
        f.local_element(i) -= factor * product.local_element(i);
    }

  private:
    const corotet::ForceContext context;
    const double                factor;
    mutable corotet::Vector     product;
  };

  class PullKind : public corotet::ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.enter_subsection("Loads");
      prm.add_parameter("Pull", w, "Angular frequency w [rad/s] of - w^2 u.");
      prm.leave_subsection();
    }

    std::vector<GivenEntry>
    given() const override
    {
      if (w == 0)
        return {};
      GivenEntry pull{"Loads/Pull", std::to_string(w), "0"};
      pull.on_mass = true;
      return {pull};
    }

    void
    add_to(corotet::ForceTerms         &terms,
           const corotet::ForceContext &context) const override
    {
      if (w != 0)
        terms.add(std::make_unique<Pull>(context, w));
    }

  private:
    double w = 0;
  };
} // namespace

// A free body that starts with v = 1 m/s in x, y and z oscillates with u =
// sin(w t) / w; here w = 2 and t = 1. The relative error of the phase w t = 2
// is (w dt)^2 / 12 with implicit midpoint, so 7e-5, and half of that with
// central differences. One Newton iteration is enough.
TEST(OutsideForces, PullOfContributing)
{
  const AddedCandidate<ForceKind> added(candidate<ForceKind, PullKind>("pull"));
  for (const bool is_explicit : {false, true})
    {
      MovingBody body(box("1, 1, 1", "2, 2, 2"),
                      element_text(2, "diagonal scaling") +
                        material_type("linear") + material_text(1, 0.3, 1) +
                        section("Loads", {{"Pull", 2}}));
      body.state.v = 1;
      ImplicitMidpoint  implicit;
      CentralDifference explicit_steps;
      TimeIntegrator   &integrator =
        is_explicit ? static_cast<TimeIntegrator &>(explicit_steps) : implicit;
      const double dt = 0.01;
      body.system.solve_acceleration(body.state, 0.);
      for (unsigned int n = 0; n < 100; ++n)
        {
          const StageReport report =
            integrator.step(body.system, {n * dt, dt, 0.01 * n}, body.state);
          EXPECT_LE(report.newton_iterations, 1u);
        }
      EXPECT_NEAR(body.state.u.linfty_norm(), std::sin(2.) / 2, 5e-5);
      Vector u(body.state.u);
      u.update_ghost_values();
      // The energy of a mass of 1 kg that moves along x, y and z.
      EXPECT_NEAR(body.system.equation().terms.energy({1., u, u}),
                  1.5 * std::pow(std::sin(2.), 2),
                  2e-4);
    }
}

// Two kinds of force may not have the same entry.
TEST(OutsideForces, EntryOfAnotherKind)
{
  class Second : public PullKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.enter_subsection("Loads");
      prm.add_parameter("Gravity", gravity, "Another one.");
      prm.leave_subsection();
    }

  private:
    std::string gravity = "1; 2; 3";
  };
  const AddedCandidate<ForceKind> added(candidate<ForceKind, Second>("second"));
  try
    {
      const ForceParameters parameters;
      ADD_FAILURE() << "nothing was refused";
    }
  catch (const std::logic_error &error)
    {
      EXPECT_STREQ(error.what(),
                   "two kinds of force have the entry 'Loads/Gravity': "
                   "'gravity' and 'second'");
    }
}

// A derivative of the wrong sign, and none at all, which differs by all of it.
TEST(OutsideForces, WrongDerivative)
{
  static double scale = 1;
  class Wrong : public Pull
  {
  public:
    using Pull::Pull;

    void
    add_force(Vector &f, const Motion &motion) const override
    {
      Pull::add_linearized(f, motion.u, 0.);
    }

    void
    add_linearized(Vector       &f,
                   const Vector &w,
                   const double  velocity_factor) const override
    {
      Vector scaled(w);
      scaled *= scale;
      Pull::add_linearized(f, scaled, velocity_factor);
    }
  };
  class WrongKind : public PullKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override
    {
      terms.add(std::make_unique<Wrong>(context, 1.), "Loads/Pull");
    }
  };
  const AddedCandidate<ForceKind> added(
    candidate<ForceKind, WrongKind>("wrong"));
  for (const auto &[value, percent] :
       {std::pair(1., ""), std::pair(-1., "2e+02"), std::pair(0., "1e+02")})
    for (const bool is_static : {false, true})
      {
        scale = value;
        CompleteRun              run(box_mesh("1, 1, 1", "1, 1, 1") +
                        (is_static ? fixed("x-min") + statics() : ""));
        std::vector<std::string> expected;
        if (value != 1)
          expected.push_back(fmt::format(
            "Loads/Pull: the derivative that the program gives differs by {} "
            "% from that of the force by finite differences: Newton's method "
            "is slow",
            percent));
        EXPECT_EQ(warnings(run), expected);
      }
}

// Explicit steps take such forces with the velocity of half a step before.
TEST(OutsideForces, VelocityInExplicitSteps)
{
  class Drag : public Pull
  {
  public:
    using Pull::Pull;

    bool
    depends_on_velocity() const override
    {
      return true;
    }
  };
  class DragKind : public PullKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override
    {
      terms.add(std::make_unique<Drag>(context, 1.));
    }
  };
  const AddedCandidate<ForceKind> added(candidate<ForceKind, DragKind>("drag"));
  const std::string               body =
    box_mesh("1, 1, 1", "1, 1, 1") + element_text(1, "row sum") +
    section("Initial conditions", {{"Velocity", "1; 0; 0"}});
  const std::string first_order = "forces that depend on the velocity get that "
                                  "of half a step before: the steps are of "
                                  "first order";
  for (const auto &[type, expected] :
       {std::pair("central difference", std::vector{first_order}),
        std::pair("Newmark", std::vector<std::string>())})
    {
      CompleteRun run(
        body +
        section("Time integration",
                {{"Type", type}, {"Time step", 1e-4}, {"End time", 2e-4}}));
      EXPECT_EQ(run.run(), "");
      EXPECT_EQ(warnings(run), expected);
    }
}

// In statics a force gets the velocity zero, also if it does not say that it
// depends on it.
TEST(OutsideForces, VelocityInStatics)
{
  class Watch : public Pull
  {
  public:
    using Pull::Pull;

    void
    add_force(Vector &f, const Motion &motion) const override
    {
      EXPECT_EQ(motion.v.size(), motion.u.size());
      EXPECT_EQ(motion.v.linfty_norm(), 0);
      Pull::add_force(f, motion);
    }
  };
  class WatchKind : public PullKind
  {
  public:
    void
    add_to(ForceTerms &terms, const ForceContext &context) const override
    {
      terms.add(std::make_unique<Watch>(context, 1.));
    }
  };
  const AddedCandidate<ForceKind> added(
    candidate<ForceKind, WatchKind>("watch"));
  MovingBody body(box("1, 1, 1", "1, 1, 1"), fixed("x-min") + statics());
  body.system.equation().evaluate_forces(body.state, 0., 1.);
}
