// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_convergence_study_h
#define corotet_studies_convergence_study_h

#include <corotet/base/log.h>
#include <corotet/output/checkpoints.h>
#include <corotet/simulation/command_line.h>
#include <corotet/studies/study_run.h>
#include <corotet/studies/transferred_field.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Runs the case of a parameter file with all degrees, refinements, time
   * steps, mass matrices and rotations that section Convergence study lists,
   * and compares the results.
   *
   * Results in the output directory: rows/NAME.json and rows/NAME.log of each
   * run, when it is finished; study.csv, study.tex and pictures of all runs. A
   * study that was stopped continues with the runs that have no file yet, and
   * an interrupted run from its newest checkpoint, in rows/NAME.
   *
   * @p log must outlive this object. Members are collective.
   */
  class ConvergenceStudy
  {
  public:
    /// Checks all runs; of those that differ only in the refinement, one.
    /// Throws InputError.
    ConvergenceStudy(const CommandLine          &command,
                     const StudyParameters      &parameters,
                     const CheckpointParameters &checkpoints,
                     const MPI_Comm              comm,
                     Log                        &log);

    /// The names of the columns of study.csv.
    std::vector<std::string>
    columns() const;

    /// Runs the study. Throws ComputationError if runs have failed, after the
    /// other runs, and Stopped if the study has to end before its time.
    void
    run(const std::string &directory);

  private:
    /// Throws Stopped if the study has to end before the next run.
    void
    stop_if_asked(const std::vector<StudyResult> &results);
    /// The result kept in the file @p path, if it belongs to the same problem.
    /// Warns if the file is damaged.
    std::optional<StudyResult>
    kept_result(const std::string            &path,
                const nlohmann::ordered_json &problem,
                const StudyCase              &study_case);
    /// The result of a run, from its file, or by running it.
    StudyResult
    result_of(const StudyCase &study_case);
    /// Warns if parts of the body differ from those in the first run of this
    /// degree: parts that are selected by place change with the mesh.
    void
    compare_parts(const StudyRun &run, const StudyCase &study_case);
    /// Runs the case that others are compared with, if that is not done yet.
    /// Null if it has failed.
    const StudyRun *
    finer_run();
    /// Sets the reference values of quantities without a value to those of the
    /// finer run.
    void
    take_finer_result(const StudyResult &result);
    /// The result of a run with an error that the first checks, with the
    /// coarsest mesh, did not find: a time step that is too long for this mesh,
    /// say.
    StudyResult
    failed_result(const StudyCase &study_case, const InputError &error) const;
    void
    compare_with_finer_run(StudyResult &result, const StudyRun &run);
    StudyCase
    finer_case() const;
    /// Throws InputError if the finest mesh has too many cells.
    void
    check_finest(const Discretization &coarsest) const;
    /// Writes tables of the results so far, and a summary.
    void
    write(const std::vector<StudyResult> &results,
          const std::string              &status,
          const std::string              &message);
    void
    draw() const;

    const CommandLine                      command;
    const StudyParameters                  parameters;
    const CheckpointParameters             checkpoints;
    const std::vector<StudyCase>           cases;
    std::vector<StudyParameters::Quantity> quantities;
    MPI_Comm                               comm;
    Log                                   &log;
    std::string                            directory;
    std::unique_ptr<StudyRun>              finer;
    FieldNorms                             finer_norms;
    /// The result of the finer run, once it is done, by this process or by one
    /// that has begun the study. Its quantities include those with a given
    /// value.
    std::optional<StudyResult> finer_result;
    /// The message if the finer run has failed, otherwise empty.
    std::string failure_of_finer_run;
    /// Whether a result of another revision of the program has been kept.
    bool keeps_other_revisions = false;
    /// The sizes of the body's parts in the first run of each degree, and
    /// whether a difference has been warned of.
    std::map<unsigned int, std::map<std::string, double>> first_sizes;
    bool has_warned_of_parts = false;
    /// Whether different volumes have been warned of.
    bool has_warned_of_volume = false;
    /// The number of runs that were not kept from an earlier start.
    unsigned int n_computed = 0;
  };
} // namespace corotet

#endif
