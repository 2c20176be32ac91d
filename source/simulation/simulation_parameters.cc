// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/simulation/simulation_parameters.h>
#include <corotet/time_integration/time_integrators.h>

namespace corotet
{
  namespace
  {
    // Declares a section by @p declare_entries.
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
  } // namespace

  SimulationParameters::SimulationParameters()
    : time_integrator(time_integrators(), "generalized-alpha")
  {}

  void
  SimulationParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii::Patterns;
    section(prm, "Mesh", [&] { mesh.declare_parameters(prm); });
    section(prm, "Discretization", [&] {
      prm.add_parameter("Degree",
                        degree,
                        "Polynomial degree of the displacement [-].",
                        Integer(1, 3));
      prm.add_parameter(
        "Mass",
        mass_type,
        "Mass matrix: 'consistent'; 'diagonal scaling', diagonal, from the "
        "consistent diagonal; 'row sum', diagonal, for degree 1 only.",
        Selection("consistent|diagonal scaling|row sum"));
    });
    section(prm, "Material", [&] { material.declare_parameters(prm); });
    section(prm, "Tables", [&] { tables.declare_parameters(prm); });
    section(prm, "Boundary conditions", [&] {
      boundary_conditions.declare_parameters(prm);
    });
    section(prm, "Loads", [&] { loads.declare_parameters(prm); });
    section(prm, "Damping", [&] { damping.declare_parameters(prm); });
    section(prm, "Initial conditions", [&] {
      prm.add_parameter("Displacement",
                        initial_displacement,
                        "At the start time [m]: 'x; y; z', expressions in x, "
                        "y, z, t.");
      prm.add_parameter("Velocity",
                        initial_velocity,
                        "At the start time [m/s]: 'x; y; z', expressions in x, "
                        "y, z, t.");
    });
    section(prm, "Time integration", [&] {
      time_integrator.declare_parameters(
        prm, "'static' steps loads without inertia; the others are dynamic.");
      prm.add_parameter("Start time", start_time, "In s.", Double());
      prm.add_parameter("End time",
                        end_time,
                        "In s, after the start time.",
                        Double());
      prm.add_parameter("Time step",
                        time_step,
                        "In s. It is shortened a little if the duration is not "
                        "a multiple of it. 0: the program's choice, with "
                        "'central difference' only. With an adaptive step the "
                        "first one.",
                        Double(0));
      prm.add_parameter("Maximum halvings",
                        max_halvings,
                        "How often a step that fails is halved before the run "
                        "ends [-]. The states at the ends of the steps asked "
                        "for are what is recorded, in how many parts ever a "
                        "step was made. Not for explicit or adaptive steps.",
                        Integer(0, 30));
      section(prm, "Adaptive step", [&] {
        adaptive_step.declare_parameters(prm);
      });
    });
    section(prm, "Newton", [&] { newton.declare_parameters(prm); });
    section(prm, "Linear solver", [&] {
      linear_solver.declare_parameters(prm);
    });
  }
} // namespace corotet
