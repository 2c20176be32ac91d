// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/expression.h>
#include <corotet/base/mpi.h>
#include <corotet/base/not_finite.h>
#include <corotet/simulation/start_checks.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace corotet
{
  namespace
  {
    const std::string displacement_entry = "Initial conditions/Displacement";

    // The initial displacement must agree with that of the supports at the
    // start.
    void
    check_supports_at_start(StructuralSystem           &system,
                            const SimulationParameters &parameters,
                            const State                &initial,
                            Log                        &log)
    {
      const Body           &body           = system.equation().body;
      const Discretization &discretization = body.discretization;
      const MPI_Comm        comm           = discretization.communicator();
      State                 moved          = initial;
      system.prescribe(moved, parameters.start_time, 1.);
      double       largest = 0;
      unsigned int unknown = 0;
      for (const unsigned int i : body.motion.unknowns())
        {
          const double difference =
            std::abs(moved.u.local_element(i) - initial.u.local_element(i));
          if (difference > largest)
            {
              largest = difference;
              unknown = i;
            }
        }
      const double largest_of_all = dealii::Utilities::MPI::max(largest, comm);
      // The tolerance is that of numbers written with six digits.
      if (largest_of_all <= 1e-6 * std::cbrt(discretization.volume()))
        return;
      // Without an initial displacement the jump of supports may be intended.
      if (norm(initial.u) == 0)
        {
          log.warning(fmt::format(
            "supports jump by up to {:.6g} m at the start, which "
            "crushes the cells there; let the displacement begin at "
            "zero, as smooth_step does, or give the body an initial "
            "displacement",
            largest_of_all));
          return;
        }
      on_all_ranks(comm, [&] {
        if (largest != largest_of_all)
          return;
        const dealii::Point<3> x = discretization.node_position(unknown / 3);
        const std::string      text =
          fmt::format("the initial displacement contradicts a support: found "
                      "{:.6g} m in {} at the node ({:.6g}, {:.6g}, {:.6g}); "
                      "allowed at t = {:g} is what Boundary conditions say, "
                      "{:.6g} m",
                      initial.u.local_element(unknown),
                      "xyz"[unknown % 3],
                      x[0],
                      x[1],
                      x[2],
                      parameters.start_time,
                      moved.u.local_element(unknown));
        throw InputError(displacement_entry, text);
      });
    }

    // Crushed cells are allowed; their det F may be slightly negative by
    // round-off.
    void
    check_inversions(const ElasticState &state)
    {
      if (state.min_det_F < -1e-8)
        throw InputError(
          displacement_entry,
          fmt::format("the initial displacement turns {} cells inside out: "
                      "found det F = {:.3g}; allowed is none below zero",
                      state.inverted_cells,
                      state.min_det_F));
    }

    // Obstacles that the body is inside of press it out, which may be intended.
    void
    warn_of_contact(const EquationOfMotion &equation, Log &log)
    {
      // The tolerance is that of numbers written with six digits.
      const double tolerance =
        1e-6 * std::cbrt(equation.body.discretization.volume());
      for (const auto &[obstacle, depth] :
           equation.terms.contact_depths(equation.last_motion()))
        if (depth > tolerance)
          log.warning(fmt::format("Contact/Obstacles: the body is up to {:.3g} "
                                  "m inside of obstacle '{}' at the start, "
                                  "which presses it out",
                                  depth,
                                  obstacle));
    }

    void
    check_loads(EquationOfMotion &equation,
                const State      &state,
                const double      time)
    {
      try
        {
          equation.evaluate_forces(state, time, 1.);
        }
      catch (const WrongValueError &error)
        {
          throw InputError(error.cause);
        }
      const auto found =
        take_not_finite(equation.body.discretization.communicator());
      if (found)
        throw InputError(found->entry, found->message);
    }
  } // namespace

  void
  check_start(StructuralSystem           &system,
              const SimulationParameters &parameters,
              const State                &initial,
              Log                        &log)
  {
    EquationOfMotion &equation = system.equation();
    const bool dynamic = parameters.time_integrator.selected().is_dynamic();
    if (dynamic)
      check_supports_at_start(system, parameters, initial, log);
    // In statics, too: their work begins there.
    check_loads(equation, initial, parameters.start_time);
    if (dynamic)
      warn_of_contact(equation, log);
    equation.set_state(initial);
    // Displacements of a linear law may be of any size.
    if (!equation.body.law->is_linear())
      check_inversions(equation.body.elasticity.state(equation.displacement()));
    // A load that is not finite is better found now than after hours.
    check_loads(equation, initial, parameters.end_time);
  }

  namespace
  {
    // User-defined laws may be wrong where bodies are not at rest.
    void
    warn_of_law(const Body &body, Log &log)
    {
      // The test uses strains of some percent, and a rotation.
      const dealii::Tensor<2, 3> H(
        {{0.02, -0.07, 0.01}, {0.05, -0.01, 0.03}, {-0.02, 0.01, 0.03}});
      constexpr double tolerance = 1e-3;
      const LawErrors  errors =
        law_errors(*body.law, body.materials.begin()->second, H);
      const std::string law = "Material/Type: the law's stress";
      // Values that are not finite come from laws that have no stress at this
      // strain.
      if (body.law->has_energy(body.discretization.degree()) &&
          errors.stress > tolerance)
        log.warning(fmt::format("{} is not the derivative of its energy, from "
                                "which it differs by {:.2g} % at strains of "
                                "some percent",
                                law,
                                100 * errors.stress));
      if (errors.stress_derivative > tolerance)
        log.warning(fmt::format("{} does not have the derivative that the law "
                                "gives, which differs by {:.2g} % at strains "
                                "of some percent: Newton's method is slow",
                                law,
                                100 * errors.stress_derivative));
    }
  } // namespace

  void
  warn_of_body(const Body &body, Log &log)
  {
    warn_of_law(body, log);
    for (const auto &[region, material] : body.materials)
      {
        // Poisson's ratio is a round number only up to round-off.
        const double      nu = poissons_ratio(material);
        const std::string found =
          fmt::format("Material/Poisson's ratio: {:.9g} of region '{}' ",
                      nu,
                      body.mesh.regions().name(region));
        const bool of_vertices = body.elasticity.vertex_dilatation() != nullptr;
        if (body.discretization.degree() == 1 && !of_vertices &&
            nu > 0.49 - 1e-9)
          log.warning(
            found +
            "makes elements of degree 1 too stiff, as the volume of each of "
            "their cells can hardly change; elements of degree 2 and 3 hardly "
            "lock" +
            (allows_vertex_dilatation(*body.law) ?
               ", nor do those of degree 1 with Dilatation = vertices" :
               ""));
        // With a ratio of 0.499 displacements of degree 2 and 3 are accurate to
        // some percent, and solvers need a few times more iterations.
        else if (nu > 0.499 + 1e-9)
          log.warning(found + "is almost that of an incompressible material: " +
                      (of_vertices ? "" : "pressures are inaccurate, and ") +
                      "solvers need many iterations; 0.499 is in general close "
                      "enough, and Linear solver/Type = direct needs no "
                      "iterations");
      }
  }

  namespace
  {
    // Forces that programs add may come with wrong derivatives. @p w moves
    // every node.
    void
    warn_of_derivatives(EquationOfMotion           &equation,
                        const SimulationParameters &parameters,
                        const Vector               &w,
                        Log                        &log)
    {
      const TimeIntegrator &integrator = parameters.time_integrator.selected();
      if (integrator.is_explicit())
        return;
      constexpr double tolerance = 1e-2;
      const bool       dynamic   = integrator.is_dynamic();
      Vector           v(w);
      v = 0;
      for (const auto &[name, error] : equation.terms.derivative_errors(
             {parameters.start_time, w, dynamic ? w : v}, w, dynamic ? 1. : 0.))
        if (error > tolerance)
          log.warning(fmt::format(
            "{}: the derivative that the program gives differs by {:.2g} % "
            "from that of the force by finite differences: Newton's method is "
            "slow",
            name.empty() ? "a force of the program" : name,
            100 * error));
    }
  } // namespace

  void
  warn_of_forces(EquationOfMotion           &equation,
                 const SimulationParameters &parameters,
                 Log                        &log)
  {
    const Body &body = equation.body;
    if (!parameters.time_integrator.selected().is_dynamic())
      {
        const std::string nothing_moves =
          ": has no effect in statics, where nothing moves";
        for (const std::string &name : equation.terms.names_of_damping())
          log.warning(name + nothing_moves);
        if (parameters.time_integrator.selected().load_factor(0.5) != 1)
          for (const std::string &name :
               equation.terms.names_of_loads_in_time())
            log.line(name + ": depends on t, and the part of the load steps "
                            "that is done multiplies it, too, unless "
                            "'Proportional loading = false'");
        const std::string entry = "Initial conditions/Velocity";
        if (!Expression(parameters.initial_velocity, 3, entry, body.tables)
               .is_zero())
          log.warning(entry + nothing_moves);
      }
    // Every node moves a little, each in another direction.
    Vector u;
    body.discretization.initialize_vector(u);
    const auto   first = u.get_partitioner()->local_range().first;
    const double size  = 1e-6 * std::cbrt(body.discretization.volume());
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      {
        // The fractional parts of multiples of the golden ratio spread evenly.
        const double multiple = 0.6180339887498949 * double(first + i);
        u.local_element(i)    = size * (0.5 + multiple - std::floor(multiple));
      }
    u.update_ghost_values();
    warn_of_derivatives(equation, parameters, u, log);
    // Loads may act for a short while only, so more times are tried.
    constexpr unsigned int n_between = 100;
    std::vector<Motion>    motions{{parameters.start_time, u, u},
                                   {parameters.end_time, u, u}};
    for (unsigned int k = 1; k < n_between; ++k)
      motions.push_back(
        {parameters.start_time +
           (parameters.end_time - parameters.start_time) * k / n_between,
         u,
         u});
    for (const std::string &name :
         equation.terms.names_without_effect(motions, body.motion))
      log.warning(name + ": has no effect but on reactions, as the "
                         "displacement is prescribed wherever it acts");
    // Values that were noted as not finite at these times belong to no step.
    take_not_finite(body.discretization.communicator());
  }

  void
  warn_of_weak_springs(const Body                              &body,
                       const std::vector<RigidMotions::Spring> &springs,
                       Log                                     &log)
  {
    const auto weak_motions = [&](const auto &all_springs) {
      return RigidMotions(body.discretization,
                          body.motion,
                          all_springs,
                          RigidMotions::weak_tolerance);
    };
    // Springs at the same places in all directions show what is due to the
    // shape of the body alone, as for rotations about the axis of a thin rod.
    std::vector<RigidMotions::Spring> in_all_directions;
    for (const RigidMotions::Spring &spring : springs)
      for (unsigned int a = 0; a < 3; ++a)
        {
          in_all_directions.push_back(spring);
          in_all_directions.back().direction    = 0;
          in_all_directions.back().direction[a] = 1;
        }
    const RigidMotions weak = weak_motions(springs);
    if (weak.size() <= weak_motions(in_all_directions).size())
      return;
    log.warning(
      "Supports/Elastic normal: hardly anything resists this: " +
      weak.description() +
      ". Springs normal to a curved surface let the body slide along it, up to "
      "the shape of the cells' faces, on which the result then depends; hold "
      "the body against this by a support or by Supports/Elastic");
  }
} // namespace corotet
