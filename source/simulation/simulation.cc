// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
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
    , mesh(parameters.mesh, folder, comm, log)
    , disc(mesh, parameters.degree)
    , system(disc, parameters, wall_times, log)
  {
    const double duration = parameters.end_time - parameters.start_time;
    if (!(duration > 0))
      throw InputError("Time integration/End time",
                       fmt::format("found {}; allowed: a time after the start "
                                   "time {}",
                                   parameters.end_time,
                                   parameters.start_time));
    if (parameters.newton.linearly_implicit &&
        !parameters.time_integrator.selected().is_dynamic())
      throw InputError("Newton/Linearly implicit",
                       "found true; allowed with Time integration/Type = "
                       "static: false, as nothing would correct the error of "
                       "a load step");
    n_steps =
      parameters.time_integrator.selected().n_steps(duration,
                                                    parameters.time_step);

    // Boundaries that disagree show themselves before the run starts.
    system.initialize(present);
    for (const double part : {0., 0.5, 1.})
      system.prescribe(present, parameters.start_time + part * duration, 1.);
    system.initialize(present);

    log.line(fmt::format(
      "Discretization: degree {}, {} cells, {} nodes, {} unknowns on {} rank{}",
      disc.degree(),
      disc.n_global_cells(),
      disc.n_global_nodes(),
      3 * disc.n_global_nodes(),
      dealii::Utilities::MPI::n_mpi_processes(comm),
      dealii::Utilities::MPI::n_mpi_processes(comm) == 1 ? "" : "s"));
    log.line(fmt::format("Body: {:.6g} kg", system.mass().total()));
    wall_times.setup = seconds();
  }

  void
  Simulation::run(const std::vector<std::unique_ptr<Observer>> &observers)
  {
    StepRecord record;
    try
      {
        compute(observers, record);
      }
    catch (const ComputationError &error)
      {
        const std::string message =
          fmt::format("step {} (t = {:.6g}): {}",
                      static_cast<unsigned int>(done * n_steps + 1e-6) + 1,
                      time(done),
                      error.what());
        if (budget)
          save(observers, record);
        finish(observers, record, "failed", message);
        throw ComputationError(message);
      }
    finish(observers, record, "done", "");
  }

  double
  Simulation::time(const double done) const
  {
    // Not a sum of steps: no round-off accumulates.
    return parameters.start_time +
           done * (parameters.end_time - parameters.start_time);
  }

  void
  Simulation::start(StepRecord &record)
  {
    const double          time       = parameters.start_time;
    const TimeIntegrator &integrator = parameters.time_integrator.selected();
    if (integrator.is_dynamic())
      {
        system.prescribe(present, time, 1.);
        system.solve_acceleration(present, time);
      }
    else
      present.v = 0;
    budget = std::make_unique<Budget>(
      system, disc, present, time, integrator.load_factor(0.));
    record           = budget->initial_record();
    record.wall_time = seconds();
    report_inversions(record);
  }

  void
  Simulation::compute(const std::vector<std::unique_ptr<Observer>> &observers,
                      StepRecord                                   &record)
  {
    start(record);
    for (const auto &observer : observers)
      {
        ScopedTimer timer(wall_times.output);
        observer->start(snapshot(record, false));
      }

    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        StepRecord next        = record;
        next.step              = step;
        next.dt                = 0;
        next.parts             = 0;
        next.newton_iterations = 0;
        next.linear_iterations = 0;
        try
          {
            advance(static_cast<double>(step - 1) / n_steps,
                    static_cast<double>(step) / n_steps,
                    parameters.max_halvings,
                    next);
          }
        catch (const ComputationError &)
          {
            if (next.parts > 0)
              // Part of the step is done: what is saved has its record.
              record = next;
            throw;
          }
        record = next;
        report_inversions(record);
        if (record.parts > 1)
          log.line(
            fmt::format("step {}: made in {} parts", step, record.parts));

        ScopedTimer timer(wall_times.output);
        for (const auto &observer : observers)
          observer->step(snapshot(record, step == n_steps));
      }
  }

  void
  Simulation::advance(const double       from,
                      const double       to,
                      const unsigned int halvings,
                      StepRecord        &record)
  {
    before_step = present;
    try
      {
        make_step(from, to, record);
        return;
      }
    catch (const ComputationError &error)
      {
        present = before_step;
        if (halvings == 0)
          {
            if (parameters.max_halvings == 0)
              throw;
            throw ComputationError(
              fmt::format("{}; the step has been halved {} times",
                          error.what(),
                          parameters.max_halvings));
          }
        log.line(fmt::format("t = {:.6g}: {}; trying half the step",
                             time(to),
                             error.what()));
      }
    const double middle = 0.5 * (from + to);
    advance(from, middle, halvings - 1, record);
    advance(middle, to, halvings - 1, record);
  }

  void
  Simulation::make_step(const double from, const double to, StepRecord &record)
  {
    TimeIntegrator   &integrator = parameters.time_integrator.selected();
    const StageReport report =
      integrator.step(system,
                      {time(from),
                       (to - from) *
                         (parameters.end_time - parameters.start_time),
                       to},
                      present);
    budget->update(record, present, time(to), integrator.load_factor(to));
    done = to;
    ++record.parts;
    record.newton_iterations += report.newton_iterations;
    record.linear_iterations += report.linear_iterations;
    record.dt += time(to) - time(from);
    record.clamped_cells = system.take_clamped_cells();
    record.wall_time     = seconds();
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
    system.evaluate(present,
                    record.time,
                    parameters.time_integrator.selected().load_factor(done));
    ScopedTimer timer(wall_times.output);
    const bool  is_shown = record.step <= done * n_steps + 1e-6;
    for (const auto &observer : observers)
      if (is_shown)
        observer->save(snapshot(record, true));
      else
        observer->step(snapshot(record, true));
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
            last};
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
    summary.total_mass      = system.mass().total();
    summary.steps           = record.step;
    summary.end_time        = record.time;
    summary.final_record    = record;
    summary.wall_times      = wall_times;
    summary.total_wall_time = seconds();
    for (const auto &observer : observers)
      observer->finish(summary);
  }

  double
  Simulation::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         started)
      .count();
  }
} // namespace corotet
