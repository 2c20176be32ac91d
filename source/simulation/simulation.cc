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
        const std::string message = fmt::format("step {} (t = {:.6g}): {}",
                                                record.step + 1,
                                                record.time,
                                                error.what());
        finish(observers, record, "failed", message);
        throw ComputationError(message);
      }
    finish(observers, record, "done", "");
  }

  void
  Simulation::start(StepRecord &record, std::unique_ptr<Budget> &budget)
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
  }

  void
  Simulation::compute(const std::vector<std::unique_ptr<Observer>> &observers,
                      StepRecord                                   &record)
  {
    TimeIntegrator &integrator = parameters.time_integrator.selected();
    const double    duration   = parameters.end_time - parameters.start_time;
    const double    dt         = duration / n_steps;

    std::unique_ptr<Budget> budget;
    start(record, budget);
    for (const auto &observer : observers)
      {
        ScopedTimer timer(wall_times.output);
        observer->start(snapshot(record, false));
      }

    for (unsigned int step = 1; step <= n_steps; ++step)
      {
        const TimeStep    time_step{record.time,
                                 dt,
                                 static_cast<double>(step) / n_steps};
        const StageReport report = integrator.step(system, time_step, present);

        const unsigned int inverted   = record.inverted_cells;
        const unsigned int degenerate = record.degenerate_cells;

        record.step              = step;
        record.dt                = dt;
        record.newton_iterations = report.newton_iterations;
        record.linear_iterations = report.linear_iterations;
        // Not a sum of steps: no round-off accumulates.
        const double time = parameters.start_time + time_step.done * duration;
        budget->update(record,
                       present,
                       time,
                       integrator.load_factor(time_step.done));
        record.wall_time = seconds();
        if (record.inverted_cells != inverted ||
            record.degenerate_cells != degenerate)
          log.warning(fmt::format("step {}: {} inverted, {} degenerate cells; "
                                  "{} rotations took the robust way",
                                  step,
                                  record.inverted_cells,
                                  record.degenerate_cells,
                                  record.robust_rotations));

        ScopedTimer timer(wall_times.output);
        for (const auto &observer : observers)
          observer->step(snapshot(record, step == n_steps));
      }
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
