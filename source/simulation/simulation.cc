// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/discretization/rigid_motions.h>
#include <corotet/operators/rotation_difference.h>
#include <corotet/simulation/simulation.h>
#include <corotet/simulation/start_checks.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace corotet
{
  namespace
  {
    bool
    is_moved(const StepRecord &record)
    {
      return record.max_displacement > 0;
    }
  } // namespace

  Simulation::Simulation(const SimulationParameters &parameters,
                         const std::string          &folder,
                         const MPI_Comm              comm,
                         Log                        &log)
    : parameters(parameters)
    , log(log)
    , the_body(parameters, folder, comm, log)
    , system(the_body, parameters, wall_times, log)
    , stepper(parameters, system, log)
  {
    the_body.describe(log);
    warn_of_body(the_body, log);
    if (parameters.time_integrator.selected().is_dynamic())
      look_for_parts();
    else
      check_supports();
    check_start(system, parameters, stepper.state(), log);
    warn_of_forces(system.equation(), parameters, log);
    wall_times.setup     = seconds();
    wall_times.read      = the_body.mesh.read_time();
    wall_times.partition = the_body.mesh.partition_time();
  }

  void
  Simulation::look_for_parts()
  {
    const ConnectedParts parts(the_body.discretization);
    // Parts on a hinge are not one piece.
    the_body.is_one_piece = parts.n_parts == 1;
    const std::string unconnected =
      unconnected_parts(the_body.discretization, parts);
    if (!unconnected.empty())
      log.warning("Mesh: " + unconnected);
  }

  std::unique_ptr<SurfaceMatrix>
  Simulation::first_springs()
  {
    try
      {
        return system.equation().terms.springs(the_body.reference,
                                               stepper.first_time());
      }
    catch (const WrongValueError &error)
      {
        throw InputError(error.cause);
      }
  }

  void
  Simulation::check_supports()
  {
    const auto         springs = first_springs();
    const RigidMotions free_motions(the_body.discretization,
                                    the_body.motion,
                                    springs ?
                                      springs->springs() :
                                      std::vector<RigidMotions::Spring>());
    the_body.is_one_piece     = free_motions.n_parts() == 1;
    const std::string motions = free_motions.description();
    if (motions.empty() && springs)
      warn_of_weak_springs(the_body, springs->springs(), log);
    if (motions.empty())
      return;
    const bool        is_made = the_body.problem.makes_data();
    const std::string entries =
      springs || !system.equation().terms.names_of_damping().empty() ?
        "Fixed, Displacement and Supports" :
        "Fixed and Displacement";
    throw InputError(is_made ? "Exact solution/Displacement boundary" :
                               "Boundary conditions/Fixed",
                     fmt::format("statics needs a body that cannot move "
                                 "without strain; found: {}; allowed: {} "
                                 "such that nothing of this "
                                 "is left, or another Time integration/Type",
                                 motions,
                                 is_made ? "boundaries" : entries));
  }

  void
  Simulation::run(const std::vector<std::unique_ptr<Observer>> &observers,
                  const OutputTimes                            &recording)
  {
    start(observers, recording);
    while (!is_done())
      step();
    finish();
  }

  void
  Simulation::guarded(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const ComputationError &error)
      {
        TimeLoop::Failure failure = stepper.last_failure();
        if (failure.step == 0)
          failure = {last_record.step + (stepper.has_partial_step() ? 0 : 1),
                     stepper.time()};
        const std::string message = fmt::format("step {} (t = {:.6g}): {}",
                                                failure.step,
                                                failure.time,
                                                error.what());
        // If observers fail now, too, the reason of the run's end is known
        // already.
        try
          {
            if (is_started)
              save();
            finish("failed", message);
          }
        catch (const MachineError &failure)
          {
            throw MachineError(message + "; and then: " + failure.what());
          }
        throw ComputationError(message);
      }
  }

  void
  Simulation::start(const std::vector<std::unique_ptr<Observer>> &observers,
                    const OutputTimes                            &recording)
  {
    this->observers = &observers;
    guarded([&] {
      last_record           = stepper.start(recording);
      has_moved             = is_moved(last_record);
      is_started            = true;
      last_record.wall_time = seconds();
      report_inversions();
      for (const auto &observer : observers)
        {
          ScopedTimer timer(wall_times.output);
          observer->start(snapshot(false));
        }
    });
  }

  void
  Simulation::resume(const std::vector<std::unique_ptr<Observer>> &observers,
                     const OutputTimes                            &recording,
                     Archive                                      &archive)
  {
    this->observers = &observers;
    transfer(archive);
    archive.within("time_loop",
                   [&] { stepper.resume(recording, archive, last_record); });
    // The body has moved before the checkpoint if any work has been done.
    has_moved  = is_moved(last_record) || last_record.external_work != 0;
    is_started = true;
    system.equation().set_state(stepper.state());
    ScopedTimer timer(wall_times.output);
    for (const auto &observer : observers)
      observer->resume(snapshot(stepper.is_done()));
  }

  void
  Simulation::save_state(Archive &archive)
  {
    transfer(archive);
    archive.within("time_loop", [&] { stepper.save(archive); });
  }

  void
  Simulation::transfer(Archive &archive)
  {
    archive.within("record", [&] { last_record.transfer(archive); });
    archive.transfer("reported_inverted", reported_inverted);
    archive.transfer("reported_degenerate", reported_degenerate);
    archive.transfer("reported_clamped", reported_clamped);
    const auto add_time = [&](const std::string &name, double &time) {
      double saved = time;
      archive.transfer(name, saved);
      if (archive.is_reading())
        time += saved;
    };
    archive.within("wall_time", [&] {
      add_time("setup", wall_times.setup);
      add_time("read", wall_times.read);
      add_time("partition", wall_times.partition);
      add_time("assembly", wall_times.assembly);
      add_time("solve", wall_times.solve);
      add_time("output", wall_times.output);
      double total = seconds();
      archive.transfer("total", total);
      if (archive.is_reading())
        earlier_seconds = total;
    });
    archive.within("implicit_solver",
                   [&] { system.implicit_solver().transfer(archive); });
    archive.within("output", [&] {
      for (const auto &observer : *observers)
        observer->transfer(archive);
    });
  }

  void
  Simulation::step(const Interruption &interruption)
  {
    guarded([&] {
      if (!stepper.next(last_record, interruption))
        return;
      has_moved             = has_moved || is_moved(last_record);
      stress_is_present     = false;
      last_record.wall_time = seconds();
      report_inversions();
      ScopedTimer timer(wall_times.output);
      for (const auto &observer : *observers)
        observer->step(snapshot(stepper.is_done()));
    });
  }

  void
  Simulation::report_inversions()
  {
    const StepRecord &record = last_record;
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
  Simulation::save()
  {
    // A failed step has left another state in the system.
    system.equation().set_state(stepper.state());
    stress_is_present = false;
    if (stepper.has_new_record())
      {
        last_record.wall_time = seconds();
        report_inversions();
      }
    ScopedTimer timer(wall_times.output);
    for (const auto &observer : *observers)
      if (stepper.has_new_record())
        observer->step(snapshot(true));
      else
        observer->save(snapshot(true));
  }

  Snapshot
  Simulation::snapshot(const bool last)
  {
    return {the_body.discretization,
            last_record,
            displacement(),
            system.equation().last_motion().v,
            [this] { return the_body.elasticity.cell_results(displacement()); },
            last,
            [this]() -> StressField & { return present_stress(); },
            stepper.support_forces()};
  }

  StressField &
  Simulation::present_stress()
  {
    if (!stress)
      stress = std::make_unique<StressField>(the_body.stress_field());
    if (!stress_is_present)
      stress->set_displacement(displacement());
    stress_is_present = true;
    return *stress;
  }

  void
  Simulation::finish(const std::string &status, const std::string &message)
  {
    RunSummary summary;
    summary.status  = status;
    summary.message = message;
    the_body.fill_in(summary);
    // Step and time are those of the state, which may be later than its last
    // record.
    summary.steps    = step_number() - (parts_made() > 0 ? 1 : 0);
    summary.end_time = time();
    summary.preconditioner_builds =
      system.implicit_solver().preconditioner_builds();
    if (is_started)
      {
        summary.errors                      = errors();
        summary.largest_rotation_difference = rotation_difference();
        system.implicit_solver().warn_of_far_motion();
        if (status == "done" && !has_moved)
          log.warning("the displacement is zero everywhere: no load, no motion "
                      "of supports and no initial condition moves the body");
      }
    summary.wall_times      = wall_times;
    summary.total_wall_time = seconds();
    for (const auto &observer : *observers)
      observer->finish(summary);
  }

  std::optional<ErrorNorms>
  Simulation::errors()
  {
    const ExactSolution *exact = the_body.problem.solution();
    if (exact == nullptr)
      return {};
    const double     t     = stepper.time();
    const ErrorNorms norms = error_norms(
      the_body.discretization,
      the_body.materials,
      displacement(),
      [&](const dealii::Point<3> &x) {
        return PointDisplacement{exact->displacement(x, t),
                                 exact->gradient(x, t)};
      },
      the_body.elasticity.vertex_dilatation());
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
    if (the_body.discretization.degree() == 1 ||
        !the_body.law->has_cell_rotation())
      return {};
    const double angle = largest_rotation_difference(the_body.discretization,
                                                     the_body.reference,
                                                     displacement());
    const std::string text =
      fmt::format("rotations inside of cells differ from those of their "
                  "centres by up to {:.3g} degrees",
                  angle * 180 / dealii::numbers::PI);
    // This limit was measured, see doc/rotations.md: below it no error exceeded
    // a percent.
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
    return earlier_seconds + std::chrono::duration<double>(
                               std::chrono::steady_clock::now() - started)
                               .count();
  }
} // namespace corotet
