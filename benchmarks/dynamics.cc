// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/simulation/structural_system.h>
#include <corotet/solvers/preconditioners.h>

#include <deal.II/base/parameter_handler.h>

#include <fmt/format.h>

#include "case_data.h"

namespace corotet::benchmarks
{
  namespace
  {
    constexpr double dynamic_tolerance = 1e-6;

    /// A run like that of the program, without its driver: the straight beam is
    /// released and falls.
    struct Run
    {
      Run(const Case &c, const std::string &solver, const double dt)
        : input(text(c, solver, dt))
        , body(input.parameters, serial_mesh(c), MPI_COMM_WORLD, input.log)
        , system(body, input.parameters, wall_times, input.log)
        , integrator(input.parameters.time_integrator.make())
      {
        system.initialize(state);
        system.prescribe(state, 0, 1);
        system.solve_acceleration(state, 0);
      }

      static std::string
      text(const Case &c, const std::string &solver, const double dt)
      {
        const auto set = [](const std::string &section,
                            const std::string &entries) {
          return "subsection " + section + "\n" + entries + "\nend\n";
        };
        return body_text(c) +
               set("Loads",
                   fmt::format("set Gravity = 0; 0; {}", -standard_fall)) +
               set("Time integration",
                   fmt::format("set Type = generalized-alpha\n"
                               "set End time = 100\nset Time step = {}",
                               dt)) +
               set("Newton",
                   fmt::format("set Tangent = frozen rotation\n"
                               "set Residual tolerance = {0}\n"
                               "set Increment tolerance = {0}",
                               dynamic_tolerance)) +
               set("Linear solver",
                   fmt::format("set Type = {}\nset Tolerance = {}",
                               solver,
                               dynamic_tolerance));
      }

      StageReport
      step()
      {
        const double      dt = input.parameters.time_step;
        const StageReport report =
          integrator->step(system, {time, dt, 0.5}, state);
        time += dt;
        return report;
      }

      ProblemInput                          input;
      WallTimes                             wall_times;
      Body                                  body;
      StructuralSystem                      system;
      const std::unique_ptr<TimeIntegrator> integrator;
      State                                 state;
      double                                time = 0;
    };

    /// The time of a Newton iteration with all that belongs to it, but without
    /// the first step, which sets up everything.
    Counters
    newton_iterations(CaseData          &data,
                      const std::string &solver,
                      const double       dt)
    {
      Run run(data.which(), solver, dt);
      run.step();
      constexpr unsigned int n_steps = 2;
      StageReport            total;
      const double           time   = seconds([&] {
        for (unsigned int i = 0; i < n_steps; ++i)
          {
            const StageReport report = run.step();
            total.newton_iterations += report.newton_iterations;
            total.linear_iterations += report.linear_iterations;
          }
      });
      const double           newton = total.newton_iterations;
      return {{"seconds", time / newton},
              {"step_s", time / n_steps},
              {"newton_iterations", newton / n_steps},
              {"linear_iterations", total.linear_iterations / newton},
              {"unknowns", 3. * run.body.discretization.n_global_nodes()}};
    }

    /**
     * One backward Euler step from rest in the bent state, with one Newton
     * iteration: rotations, forces, matrix, preconditioner (new numbers in the
     * patterns of the step before) and solution of (K + M / dt^2) du = weight -
     * f(u).
     */
    Counters
    backward_euler_step(CaseData &data, const std::string &solver)
    {
      Problem     &problem = data.problem();
      auto        &A       = data.effective();
      const Vector u       = problem.bent(1.5);
      const Vector weight  = problem.weight();
      const double dt      = first_period() / 10;
      const auto   P       = make_preconditioner(solver);
      Vector       r(weight), du(weight);
      Counters     result;
      data.matrix();
      const auto step = [&] {
        problem.elasticity.update_rotations_and_force(r, u);
        r.sadd(-1., weight);
        problem.clamp(r);
        A.update(1., 1 / (dt * dt));
        result["setup_s"] = seconds([&] { P->build(A, u); });
        result["solve_s"] = seconds([&] {
          result["cg_iterations"] =
            conjugate_gradients(A, du, r, *P, dynamic_tolerance);
        });
      };
      // The first step also finds the patterns of matrix and preconditioner,
      // which the second one, like all later ones, reuses.
      result["first_s"]  = seconds(step);
      result["seconds"]  = seconds(step);
      result["unknowns"] = problem.n_unknowns();
      problem.reset_rotations();
      A.update(1., 0.);
      return result;
    }
  } // namespace

  void
  add_dynamics(CaseData &data)
  {
    for (const auto &candidate : preconditioners())
      if (candidate.name != "direct")
        {
          const std::string type = candidate.name;
          add_long(data.name("newton/" + type), [&data, type] {
            return newton_iterations(data, type, first_period() / 100);
          });
          add_long(data.name("newton_short_step/" + type), [&data, type] {
            return newton_iterations(data, type, first_period() / 1000);
          });
          add_long(
            data.name("backward_euler/" + type),
            [&data, type] { return backward_euler_step(data, type); },
            3);
        }
  }
} // namespace corotet::benchmarks
