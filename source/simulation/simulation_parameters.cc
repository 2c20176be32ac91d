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
                      "Lowest modes to be computed, rigid body modes included "
                      "[-]; at most a quarter of the unknowns.",
                      Integer(1));
    prm.add_parameter("Tolerance",
                      tolerance,
                      "Largest residual |K phi - omega^2 M phi| of a mode, "
                      "relative to |omega^2 M phi| (rigid body modes: with "
                      "the lowest omega that is not zero) [-]. Frequencies are "
                      "about as accurate as its square.",
                      Double(1e-12, 0.1));
    prm.add_parameter("Shift",
                      shift,
                      "s > 0 in K + s M [1/s^2], the matrix that is solved "
                      "with; best somewhat smaller than omega^2 of the lowest "
                      "mode that deforms the body, at most 10 times that. 0: a "
                      "hundredth of it, after a first look.",
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
      "What is computed: 'simulation', the body's motion or its response to "
      "load steps; 'modes', its lowest natural frequencies and shapes of "
      "vibration; 'convergence study', many runs of either kind, to see what "
      "their results converge to and how fast.");
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
        "Mass matrix: 'consistent'; 'diagonal scaling', diagonal, from the "
        "consistent diagonal; 'row sum', diagonal, for degree 1 only; 'nodal "
        "quadrature', diagonal and as accurate as 'consistent', for degree 2 "
        "only: elements get five bubble functions more, with nodes on faces "
        "and in cells.");
    });
    section(prm, "Material", [&] { material.declare_parameters(prm); });
    section(prm, "Tables", [&] { tables.declare_parameters(prm); });
    section(prm, "Boundary conditions", [&] {
      boundary_conditions.declare_parameters(prm);
    });
    forces.declare_parameters(prm);
    section(prm, "Initial conditions", [&] {
      prm.add_parameter("Displacement",
                        initial_displacement,
                        "At the start time [m]: 'x; y; z', expressions in x, "
                        "y, z, t. It must agree with supports, and turn no "
                        "cell inside out. Statics: the first guess.");
      prm.add_parameter("Velocity",
                        initial_velocity,
                        "At the start time [m/s]: 'x; y; z', expressions in x, "
                        "y, z, t.");
    });
    section(prm, "Exact solution", [&] {
      exact_solution.declare_parameters(prm);
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
                        "first one. A run may have 4000000000 steps.",
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
