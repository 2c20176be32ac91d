// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/simulation_parameters.h>
#include <corotet/time_integration/time_integrators.h>

#include <fmt/format.h>

namespace corotet
{
  namespace
  {
    // Declares the entries of a section with @p declare_entries.
    template <typename Function>
    void
    section(dealii::ParameterHandler &prm,
            const std::string        &name,
            const Function           &declare_entries)
    {
      prm.enter_subsection(name);
      declare_entries();
      prm.leave_subsection();
    }



    void
    declare_mesh_parameters(dealii::ParameterHandler &prm, MeshParameters &mesh)
    {
      section(prm, "Mesh", [&] { mesh.declare_parameters(prm); });
      section(prm, "Selections", [&] {
        mesh.selections.declare_parameters(prm);
      });
    }



    void
    declare_initial_conditions(dealii::ParameterHandler &prm,
                               std::string              &displacement,
                               std::string              &velocity)
    {
      section(prm, "Initial conditions", [&] {
        prm.add_parameter(
          "Displacement",
          displacement,
          "Displacement at the start [m]: 'x; y; z', expressions "
          "in x, y, z, t. It must agree with supports and turn "
          "no cell inside out. Statics: the first guess.");
        prm.add_parameter(
          "Velocity",
          velocity,
          "Velocity at the start [m/s]: 'x; y; z', expressions "
          "in x, y, z, t. Where a support prescribes the motion, "
          "its velocity counts instead.");
      });
    }
  } // namespace

  SimulationParameters::SimulationParameters()
    : time_integrator(time_integrators(), "generalized-alpha")
  {}

  void
  ModesParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    prm.add_parameter("Number",
                      number,
                      "Number of lowest modes to be computed, rigid body modes "
                      "included [-]; at most a quarter of the unknowns that "
                      "are not prescribed.",
                      Integer(1));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Largest residual |K phi - omega^2 M phi| that a mode "
                      "may have, relative to |omega^2 M phi| (for rigid body "
                      "modes, with the lowest omega that is not zero) [-]. The "
                      "relative error of frequencies is about its square.",
                      Double(1e-12, 0.1));
    prm.add_parameter("Shift",
                      shift,
                      "Shift s > 0 of the eigenvalue solver, which solves "
                      "linear systems with K + s M [1/s^2]. Best is 1e-3 to "
                      "0.1 times omega^2 of the lowest mode that deforms the "
                      "body; more than 10 times that is an error. 0: the "
                      "program estimates this omega^2 and chooses s, mostly a "
                      "hundredth of it.",
                      Double(0));
  }

  void
  SimulationParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    add_enumeration(
      prm,
      "Type",
      type,
      run_types,
      "What is computed: 'simulation', the body's motion or response to load "
      "steps; 'modes', its lowest natural frequencies and shapes; 'convergence "
      "study', many runs of either kind, and how fast they converge.");
    declare_mesh_parameters(prm, mesh);
    section(prm, "Discretization", [&] {
      prm.add_parameter("Degree",
                        degree,
                        "Polynomial degree of the displacement [-].",
                        Integer(1, 3));
      add_enumeration(
        prm,
        "Mass",
        mass,
        mass_types,
        "Mass matrix: 'consistent', or diagonal, so that explicit steps solve "
        "no linear system: 'diagonal scaling', from the diagonal of "
        "'consistent'; 'row sum', for degree 1; 'nodal quadrature', for degree "
        "2, with five bubble functions more, as accurate as 'consistent'.");
    });
    section(prm, "Material", [&] { material.declare_parameters(prm); });
    section(prm, "Tables", [&] { tables.declare_parameters(prm); });
    section(prm, "Boundary conditions", [&] {
      boundary_conditions.declare_parameters(prm);
    });
    forces.declare_parameters(prm);
    declare_initial_conditions(prm, initial_displacement, initial_velocity);
    section(prm, "Exact solution", [&] {
      exact_solution.declare_parameters(prm);
    });
    section(prm, "Time integration", [&] {
      time_integrator.declare_parameters(
        prm,
        "Method: 'static', load steps without inertia; 'central difference', "
        "explicit time steps; the others, implicit time steps.");
      prm.add_parameter("Start time", start_time, "Start time [s].", Double());
      prm.add_parameter("End time",
                        end_time,
                        "End of the run [s], after the start time.",
                        Double());
      prm.add_parameter("Time step",
                        time_step,
                        "Length of the steps [s] (of the first, if adaptive), "
                        "shortened a little to divide the duration. 0: 'Safety "
                        "factor' times the stable step, with 'central "
                        "difference' only. A run may have 4000000000 steps.",
                        Double(0));
      prm.add_parameter("Maximum halvings",
                        max_halvings,
                        "How often a load step or implicit time step that "
                        "fails is halved, to be made in parts, before the run "
                        "ends [-]. Results are those at the ends of whole "
                        "steps. Not for explicit or adaptive steps.",
                        Integer(0, 30));
      section(prm, "Adaptive step", [&] {
        adaptive_step.declare_parameters(prm);
      });
    });
    section(prm, "Newton", [&] { newton.declare_parameters(prm); });
    section(prm, "Linear solver", [&] {
      linear_solver.declare_parameters(prm);
    });
    section(prm, "Modes", [&] { modes.declare_parameters(prm); });
  }

  Element
  SimulationParameters::element() const
  {
    if (mass != MassType::nodal_quadrature)
      return degree;
    if (degree != 2)
      throw InputError("Discretization/Mass",
                       fmt::format("found 'nodal quadrature' with degree {}; "
                                   "allowed: degree 2, or another mass matrix",
                                   degree));
    return Element::quadratic_with_bubbles();
  }
} // namespace corotet
