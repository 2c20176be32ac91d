// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_study_run_h
#define corotet_studies_study_run_h

#include <corotet/base/parameter_file.h>
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
   * What a study keeps of a run.
   */
  struct StudyResult
  {
    StudyCase study_case;
    /// "done" or "failed", and why.
    std::string status = "done";
    std::string message;

    std::size_t cells    = 0;
    std::size_t nodes    = 0;
    std::size_t unknowns = 0;
    /// Edge of the regular tetrahedron that has the mean volume of the cells
    /// [m].
    double h = 0;
    /// Against the exact solution, or a finer run.
    std::optional<ErrorNorms> errors;
    /// In the order of the study's quantities; not a number where the run has
    /// failed.
    std::vector<double> quantities;

    unsigned int steps = 0;
    /// The time that the run is long, over its steps [s]: not the one asked for
    /// where that does not divide it.
    double       mean_time_step    = 0;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;
    WallTimes    wall_times;
    double       total_wall_time = 0;
    /// Over all ranks.
    std::size_t peak_memory_bytes = 0;
    /// What its log counts: "2 warnings, 5 steps made in parts".
    std::string worth_a_look;
  };

  /// For the log: its size, what it took, and how it ended.
  std::string
  describe(const StudyResult &result);

  nlohmann::ordered_json
  result_to_json(const StudyResult &result);

  /// The result of @p study_case as result_to_json() gave it. Throws
  /// nlohmann::json::exception if the object is none.
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
    /// everything. Lines of the run's log go nowhere until compute(). Throws
    /// InputError.
    StudyRun(const std::string              &path,
             const std::vector<std::string> &overrides,
             const StudyCase                &study_case,
             const MPI_Comm                  comm);
    ~StudyRun();

    /// All parameters but those of the study and of the output, and what tells
    /// whether mesh and tables are the same: to recognize results of another
    /// problem by. Collective.
    nlohmann::ordered_json
    fingerprint() const;

    /// Volumes of regions [m^3] and areas of boundaries [m^2] at rest that are
    /// selected by place, by what they are called. Collective.
    std::map<std::string, double>
    sizes_of_selected_parts() const;

    /**
     * Runs it, with its log in @p path.log and its checkpoints in the folder
     * @p path. @p goes_on: from the newest checkpoint that is good and of the
     * same parameters, if there is one. @p saves_end: the end is a checkpoint,
     * too. A failure is part of the result. Throws InputError if a quantity is
     * unknown, and Stopped after a signal.
     */
    StudyResult
    compute(const std::string &path, const bool goes_on, const bool saves_end);

    /// Null if the run is one of modes.
    const Simulation *
    simulation() const
    {
      return simulated.get();
    }

  private:
    void
    simulate(StudyResult       &result,
             const std::string &path,
             const bool         goes_on,
             const bool         saves_end);
    void
    analyse_modes(StudyResult &result);
    /// By name, of the modes that have been computed; others are not numbers.
    nlohmann::ordered_json
    frequencies() const;
    /// The values of the quantities among those that the run has.
    std::vector<double>
    pick(const nlohmann::ordered_json &values) const;

    ParameterFile                  file;
    RunParameters                  parameters;
    StudyCase                      study_case;
    MPI_Comm                       comm;
    Log                            log;
    std::unique_ptr<Simulation>    simulated;
    std::unique_ptr<ModalAnalysis> analysis;
  };
} // namespace corotet

#endif
