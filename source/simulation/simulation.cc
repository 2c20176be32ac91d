// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/discretization/rigid_motions.h>
#include <corotet/operators/rotation_difference.h>
#include <corotet/simulation/simulation.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace corotet
{
  Simulation::Simulation(SimulationParameters &parameters,
                         const std::string    &folder,
                         const MPI_Comm        comm,
                         Log                  &log)
    : parameters(parameters)
    , log(log)
    , tables(read_table_functions(parameters.tables, folder, comm))
    , mesh(parameters.mesh, folder, comm, log, parameters.element().degree())
    , disc(mesh, parameters.element())
    , system(disc, parameters, tables, wall_times, log)
    , stepper(parameters, disc, system, log)
  {
    log.line(fmt::format(
      "Discretization: degree {}{}, {} cells, {} nodes, {} unknowns on {} rank{}",
      disc.degree(),
      disc.element().has_bubbles() ? " with bubbles" : "",
      disc.n_global_cells(),
      disc.n_global_nodes(),
      3 * disc.n_global_nodes(),
      dealii::Utilities::MPI::n_mpi_processes(comm),
      dealii::Utilities::MPI::n_mpi_processes(comm) == 1 ? "" : "s"));
    log.line(fmt::format("Body: {:.6g} kg", system.mass().total()));
    if (!parameters.time_integrator.selected().is_dynamic())
      check_supports();
    wall_times.setup = seconds();
  }

  void
  Simulation::check_supports()
  {
    const SurfaceMatrix *springs = system.springs(parameters.start_time);
    const std::string    motions =
      RigidMotions(disc,
                   system.prescribed_motion(),
                   springs != nullptr ? springs->springs() :
                                        std::vector<RigidMotions::Spring>())
        .description();
    if (!motions.empty())
      throw InputError("Boundary conditions/Fixed",
                       fmt::format("statics needs a body that cannot move "
                                   "without strain; found: {}; allowed: {} "
                                   "such that nothing of this "
                                   "is left, or another Time integration/Type",
                                   motions,
                                   springs != nullptr ?
                                     "Fixed, Displacement and Supports" :
                                     "Fixed and Displacement"));
  }

  void
  Simulation::run(const std::vector<std::unique_ptr<Observer>> &observers,
                  const Recording                              &recording)
  {
    StepRecord record;
    try
      {
        compute(observers, recording, record);
      }
    catch (const ComputationError &error)
      {
        const std::string message =
          fmt::format("step {} (t = {:.6g}): {}",
                      record.step + (stepper.has_partial_step() ? 0 : 1),
                      stepper.time(),
                      error.what());
        if (is_started)
          save(observers, record);
        finish(observers, record, "failed", message);
        throw ComputationError(message);
      }
    finish(observers, record, "done", "");
  }

  void
  Simulation::compute(const std::vector<std::unique_ptr<Observer>> &observers,
                      const Recording                              &recording,
                      StepRecord                                   &record)
  {
    record           = stepper.start(recording);
    is_started       = true;
    record.wall_time = seconds();
    report_inversions(record);
    for (const auto &observer : observers)
      {
        ScopedTimer timer(wall_times.output);
        observer->start(snapshot(record, false));
      }
    while (!stepper.is_done())
      {
        stepper.next(record);
        stress_is_present = false;
        record.wall_time  = seconds();
        report_inversions(record);
        ScopedTimer timer(wall_times.output);
        for (const auto &observer : observers)
          observer->step(snapshot(record, stepper.is_done()));
      }
  }

  void
  Simulation::report_inversions(const StepRecord &record)
  {
    if (record.inverted_cells == reported_inverted &&
        record.degenerate_cells == reported_degenerate &&
        record.clamped_cells == reported_clamped)
      return;
    reported_inverted   = record.inverted_cells;
    reported_degenerate = record.degenerate_cells;
    reported_clamped    = record.clamped_cells;
    std::string text    = fmt::format("step {}: smallest det F {:.3g}, {} "
                                      "inverted and {} degenerate cells",
                                   record.step,
                                   record.min_det_F,
                                   record.inverted_cells,
                                   record.degenerate_cells);
    if (record.robust_rotations > 0)
      text += fmt::format("; rotations of {} cells by singular value "
                          "decomposition",
                          record.robust_rotations);
    if (record.clamped_cells > 0)
      text += fmt::format("; derivatives of rotations clamped in {} cells",
                          record.clamped_cells);
    if (record.inverted_cells + record.degenerate_cells > 0)
      log.warning(text);
    else
      log.line(text);
  }

  void
  Simulation::save(const std::vector<std::unique_ptr<Observer>> &observers,
                   StepRecord                                   &record)
  {
    // What the failed step has left in the system is not the state.
    system.set_state(stepper.state());
    stress_is_present = false;
    ScopedTimer timer(wall_times.output);
    for (const auto &observer : observers)
      if (stepper.has_partial_step())
        observer->step(snapshot(record, true));
      else
        observer->save(snapshot(record, true));
  }

  Snapshot
  Simulation::snapshot(const StepRecord &record, const bool last)
  {
    return {disc,
            record,
            system.displacement(),
            system.velocity(),
            [this] {
              return system.elasticity().cell_results(system.displacement());
            },
            last,
            [this]() -> StressField & { return present_stress(); }};
  }

  StressField &
  Simulation::present_stress()
  {
    if (!stress)
      stress =
        std::make_unique<StressField>(disc,
                                      system.reference_element(),
                                      parameters.material.materials(
                                        mesh.regions()),
                                      parameters.material.rotation_placement());
    if (!stress_is_present)
      stress->set_displacement(system.displacement());
    stress_is_present = true;
    return *stress;
  }

  void
  Simulation::finish(const std::vector<std::unique_ptr<Observer>> &observers,
                     const StepRecord                             &record,
                     const std::string                            &status,
                     const std::string                            &message)
  {
    RunSummary summary;
    summary.status  = status;
    summary.message = message;
    summary.ranks =
      dealii::Utilities::MPI::n_mpi_processes(disc.communicator());
    summary.degree = disc.degree();
    summary.cells  = disc.n_global_cells();
    summary.nodes  = disc.n_global_nodes();
    summary.dofs   = 3 * disc.n_global_nodes();
    double volume  = 0;
    for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
      volume += disc.geometry(c).volume;
    summary.mesh_volume =
      dealii::Utilities::MPI::sum(volume, disc.communicator());
    summary.total_mass            = system.mass().total();
    summary.steps                 = record.step;
    summary.end_time              = record.time;
    summary.final_record          = record;
    summary.preconditioner_builds = system.preconditioner_builds();
    if (is_started)
      {
        summary.errors                      = errors();
        summary.largest_rotation_difference = rotation_difference();
      }
    summary.wall_times      = wall_times;
    summary.total_wall_time = seconds();
    for (const auto &observer : observers)
      observer->finish(summary);
  }

  std::optional<ErrorNorms>
  Simulation::errors()
  {
    const ExactSolution *exact = system.exact_solution();
    if (exact == nullptr)
      return {};
    const double     t = stepper.time();
    const ErrorNorms norms =
      error_norms(disc,
                  parameters.material.materials(mesh.regions()),
                  system.displacement(),
                  [&](const dealii::Point<3> &x) {
                    return PointDisplacement{exact->displacement(x, t),
                                             exact->gradient(x, t)};
                  });
    const auto text = [](const double error, const double reference) {
      return fmt::format("{:.4g} ({:.3g} %)", error, 100 * error / reference);
    };
    log.line(fmt::format("Errors at t = {:.6g} s: L2 {}, H1 {}, energy norm {}",
                         t,
                         text(norms.error.L2, norms.reference.L2),
                         text(norms.error.H1, norms.reference.H1),
                         text(norms.error.energy, norms.reference.energy)));
    return norms;
  }

  std::optional<double>
  Simulation::rotation_difference()
  {
    const Rotation placement = system.elasticity().rotation_placement();
    if (disc.degree() == 1 || (placement != Rotation::cell_centre &&
                               placement != Rotation::cell_centre_variational))
      return {};
    const double      angle = largest_rotation_difference(disc,
                                                     system.reference_element(),
                                                     system.displacement());
    const std::string text =
      fmt::format("rotations inside of cells differ from those of their "
                  "centres by up to {:.3g} degrees",
                  angle * 180 / dealii::numbers::PI);
    // Measured, see doc/rotations.md: with less no error was above a percent.
    if (angle > 0.005)
      log.warning(text + ", which may make errors of some percent; finer cells "
                         "or Material/Rotation = quadrature points make them "
                         "small");
    else
      log.line("Material: " + text);
    return angle;
  }

  double
  Simulation::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         started)
      .count();
  }
} // namespace corotet
