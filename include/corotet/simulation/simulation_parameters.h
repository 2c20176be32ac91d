// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_simulation_parameters_h
#define corotet_simulation_simulation_parameters_h

#include <corotet/base/selectable.h>
#include <corotet/base/table_functions.h>
#include <corotet/discretization/boundary_conditions.h>
#include <corotet/discretization/element.h>
#include <corotet/forces/force_kind.h>
#include <corotet/laws/material_parameters.h>
#include <corotet/material/exact_solution.h>
#include <corotet/mesh/mesh.h>
#include <corotet/operators/mass.h>
#include <corotet/simulation/adaptive_step.h>
#include <corotet/solvers/linear_solver.h>
#include <corotet/solvers/newton.h>
#include <corotet/time_integration/time_integrator.h>

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace corotet
{
  /// The kind of run.
  enum class RunType
  {
    simulation,
    modes,
    convergence_study
  };

  inline const Enumeration<RunType> run_types{
    {"simulation", RunType::simulation},
    {"modes", RunType::modes},
    {"convergence study", RunType::convergence_study}};

  /**
   * The parameters of section Modes.
   */
  struct ModesParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    unsigned int number    = 10;
    double       tolerance = 1e-8;
    /// The shift [1/s^2]; if it is 0, it is estimated.
    double shift = 0;
  };

  /**
   * All parameters of a run but those of its output. They do not change once
   * they are read, so that any number of bodies and systems may be made from
   * them. Must not be moved after declare_parameters().
   */
  struct SimulationParameters
  {
    SimulationParameters();

    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// The element for the entries Degree and Mass. Throws InputError if they
    /// do not fit.
    Element
    element() const;

    RunType                     type = RunType::simulation;
    MeshParameters              mesh;
    unsigned int                degree = 2;
    MassType                    mass   = MassType::consistent;
    MaterialParameters          material;
    TableParameters             tables;
    BoundaryConditionParameters boundary_conditions;
    ForceParameters             forces;
    /// Expressions of the initial state at the start time.
    std::string                initial_displacement = "0; 0; 0";
    std::string                initial_velocity     = "0; 0; 0";
    ExactSolutionParameters    exact_solution;
    Selectable<TimeIntegrator> time_integrator;
    double                     start_time   = 0;
    double                     end_time     = 1;
    double                     time_step    = 0.01;
    unsigned int               max_halvings = 8;
    AdaptiveStepParameters     adaptive_step;
    NewtonParameters           newton;
    LinearSolverParameters     linear_solver;
    ModesParameters            modes;
  };
} // namespace corotet

#endif
