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
   * and compares what comes out.
   *
   * Results in the output directory: rows/NAME.json and rows/NAME.log of each
   * run, when it is finished; study.csv, study.tex and pictures of all. A study
   * that was stopped goes on with the runs that have no file yet, the one that
   * was under way from its newest checkpoint, in rows/NAME.
   *
   * @p log must outlive this object. Members are collective.
   */
  class ConvergenceStudy
  {
  public:
    /// Checks all runs, those that differ in the refinement only once. Throws
    /// InputError.
    ConvergenceStudy(const CommandLine          &command,
                     const StudyParameters      &parameters,
                     const CheckpointParameters &checkpoints,
                     const MPI_Comm              comm,
                     Log                        &log);

    /// Those that study.csv will have.
    std::vector<std::string>
    columns() const;

    /// Throws ComputationError if runs have failed, after the others, and
    /// Stopped if it is to end before its time.
    void
    run(const std::string &directory);

  private:
    /// Throws Stopped if the study is to end before the next run.
    void
    stop_if_asked(const std::vector<StudyResult> &results);
    /// What is kept in the file @p path, if that is of the same problem. Warns
    /// of one that is damaged.
    std::optional<StudyResult>
    kept_result(const std::string            &path,
                const nlohmann::ordered_json &problem,
                const StudyCase              &study_case);
    /// From its file, or by running it.
    StudyResult
    result_of(const StudyCase &study_case);
    /// Warns of parts of the body that are not what they were in the first run
    /// of this degree: what is selected by place changes with the mesh.
    void
    compare_parts(const StudyRun &run, const StudyCase &study_case);
    /// Runs the case that others are compared with, if it is not done yet.
    /// Null if it has failed.
    const StudyRun *
    finer_run();
    /// Quantities without a value to be compared with have those of the finer
    /// run.
    void
    take_finer_result(const StudyResult &result);
    /// Of a run that finds an error that the checks before the first one, of
    /// the coarsest mesh, did not: a step that is too long for it, say.
    StudyResult
    failed_result(const StudyCase &study_case, const InputError &error) const;
    void
    compare_with_finer_run(StudyResult &result, const StudyRun &run);
    StudyCase
    finer_case() const;
    /// Throws InputError if the finest mesh has too many cells.
    void
    check_finest(const Discretization &coarsest) const;
    /// Tables of what there is, and a summary.
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
    /// Of the finer run, once it is done, in this process or in one that the
    /// study was begun by. Quantities are also those that have a value to be
    /// compared with.
    std::optional<StudyResult> finer_result;
    /// Empty if it has not failed.
    std::string failure_of_finer_run;
    /// Sizes of the body's parts in the first run of each degree, and whether
    /// they have been warned of.
    std::map<unsigned int, std::map<std::string, double>> first_sizes;
    bool has_warned_of_parts = false;
    /// Whether volumes that differ have been warned of.
    bool has_warned_of_volume = false;
    /// Of the runs that were not kept from an earlier start.
    unsigned int n_computed = 0;
  };
} // namespace corotet

#endif
