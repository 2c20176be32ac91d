// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_study_run_h
#define corotet_studies_study_run_h

#include <corotet/base/parameter_file.h>
#include <corotet/output/history_writer.h>
#include <corotet/simulation/modal_analysis.h>
#include <corotet/simulation/simulation.h>
#include <corotet/studies/run_parameters.h>
#include <corotet/studies/study_parameters.h>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The result of a run that a study keeps.
   */
  struct StudyResult
  {
    StudyCase study_case;
    /// "done" or "failed", and the reason.
    std::string status = "done";
    std::string message;

    std::size_t cells    = 0;
    std::size_t nodes    = 0;
    std::size_t unknowns = 0;
    /// The edge of the regular tetrahedron with the mean volume of the cells
    /// [m].
    double h = 0;
    /// Errors relative to the exact solution, or to a finer run.
    std::optional<ErrorNorms> errors;
    /// The values of the study's quantities, in their order; not a number if
    /// the run has failed.
    std::vector<double> quantities;

    unsigned int steps = 0;
    /// The simulated time divided by the number of steps [s]: it differs from
    /// the given time step if that does not divide the time.
    double       mean_time_step    = 0;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    WallTimes    wall_times;
    double       total_wall_time = 0;
    /// The largest memory, summed over all ranks.
    std::size_t peak_memory_bytes = 0;
    /// The counts of the run's log: "2 warnings, 5 steps made in parts".
    std::string worth_a_look;
  };

  /// A text for the log: the size of a run, its cost, and its end; its own log
  /// is rows/@p log_name.log.
  std::string
  describe(const StudyResult &result, const std::string &log_name);

  nlohmann::ordered_json
  result_to_json(const StudyResult &result);

  /// The result of @p study_case from the object that result_to_json() made.
  /// Throws nlohmann::json::exception if the object has another form.
  StudyResult
  result_from_json(const StudyCase              &study_case,
                   const nlohmann::ordered_json &object);

  /**
   * One run of a study: the parameter file with the values of a StudyCase.
   * Members are collective.
   */
  class StudyRun
  {
  public:
    /// Reads @p path with @p overrides and those of @p study_case, and checks
    /// everything. The run's log is discarded before compute(). Throws
    /// InputError.
    StudyRun(const std::string              &path,
             const std::vector<std::string> &overrides,
             const StudyCase                &study_case,
             const MPI_Comm                  comm);
    ~StudyRun();

    /// The data to recognize results of another problem: all parameters but
    /// those of the study and of the output, and checksums of mesh and tables.
    /// Collective.
    nlohmann::ordered_json
    fingerprint() const;

    /// The volumes of regions [m^3] and areas of boundaries [m^2] at rest that
    /// are selected by place, by their names. Collective.
    std::map<std::string, double>
    sizes_of_selected_parts() const;

    /**
     * Runs the case, with its log in @p path.log and its checkpoints in the
     * folder @p path. @p goes_on: continues from the newest good checkpoint
     * with the same parameters, if there is one. @p saves_end: writes a
     * checkpoint at the end. A failure is part of the result. Throws InputError
     * if a quantity is unknown, and Stopped after a signal.
     */
    StudyResult
    compute(const std::string &path, const bool goes_on, const bool saves_end);

    /// The simulation; null if modes are computed.
    const Simulation *
    simulation() const
    {
      return simulated.get();
    }

    /// Throws InputError if the simulation would have too many steps.
    void
    check_times() const
    {
      simulated->check({1, parameters.output.time_between_results});
    }

    /// Whether errors of a simulation depend on Time integration/Time step.
    bool
    depends_on_time_step() const
    {
      return parameters.simulation.time_integrator.selected().is_dynamic() &&
             !parameters.simulation.adaptive_step.enabled;
    }

  private:
    void
    simulate(StudyResult       &result,
             const std::string &path,
             const bool         goes_on,
             const bool         saves_end);
    void
    analyse_modes(StudyResult &result);
    /// The frequencies of the computed modes by name; others are not numbers.
    nlohmann::ordered_json
    frequencies() const;
    /// The study's quantities among the @p values of the run.
    std::vector<double>
    pick(const nlohmann::ordered_json &values) const;

    ParameterFile                  file;
    RunParameters                  parameters;
    StudyCase                      study_case;
    MPI_Comm                       comm;
    Log                            log;
    std::unique_ptr<Simulation>    simulated;
    std::unique_ptr<ModalAnalysis> analysis;
    /// The columns of a simulation.
    std::optional<HistoryColumns> columns;
  };
} // namespace corotet

#endif
