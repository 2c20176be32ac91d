// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The finer run that a study's runs are compared with, the comparison with the
// body of the first run, and runs that fail before they begin.

#include <corotet/base/exceptions.h>
#include <corotet/studies/convergence_study.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sizes_of_parts.h"

namespace corotet
{
  StudyResult
  ConvergenceStudy::failed_result(const StudyCase  &study_case,
                                  const InputError &error) const
  {
    StudyResult result;
    result.study_case = study_case;
    result.status     = "failed";
    result.message =
      (error.entry.empty() ? "" : error.entry + ": ") + error.what();
    result.quantities.assign(quantities.size(), std::nan(""));
    return result;
  }

  void
  ConvergenceStudy::compare_parts(const StudyRun  &run,
                                  const StudyCase &study_case)
  {
    if (has_warned_of_parts)
      return;
    const auto sizes = run.sizes_of_selected_parts();
    // Curved bodies have other sizes if the degree differs.
    const auto [first, is_new] = first_sizes.emplace(study_case.degree, sizes);
    const std::string changed =
      is_new ? "" : describe_changed_parts(first->second, sizes);
    if (changed.empty())
      return;
    has_warned_of_parts = true;
    log.warning(study_case.name() + ": " + changed +
                " in an earlier run, so runs are not of the same body: limits "
                "of 'Selections' should be where all meshes have sides of "
                "cells");
  }

  StudyCase
  ConvergenceStudy::finer_case() const
  {
    StudyCase finest = cases.front();
    for (const StudyCase &one : cases)
      {
        finest.degree      = std::max(finest.degree, one.degree);
        finest.refinements = std::max(finest.refinements, one.refinements);
        if (one.time_step)
          finest.time_step = std::min(*finest.time_step, *one.time_step);
      }
    finest.refinements += parameters.further_refinements;
    // If all runs have the same time step, the finer run has it, too: then it
    // has the same error in time.
    const bool varies_time =
      std::any_of(cases.begin(), cases.end(), [&](const StudyCase &one) {
        return one.time_step != finest.time_step;
      });
    if (finest.time_step && varies_time)
      *finest.time_step /= 4;
    // The finer run has the file's own mass matrix and rotation.
    finest.mass.reset();
    finest.rotation.reset();
    return finest;
  }

  void
  ConvergenceStudy::take_finer_result(const StudyResult &result)
  {
    finer_result = result;
    for (unsigned int i = 0; i < quantities.size(); ++i)
      if (!quantities[i].reference)
        quantities[i].reference = result.quantities.at(i);
  }

  const StudyRun *
  ConvergenceStudy::finer_run()
  {
    if (finer)
      return finer.get();
    StudyResult result;
    try
      {
        finer = std::make_unique<StudyRun>(command.parameter_file,
                                           command.overrides,
                                           finer_case(),
                                           comm);
        compare_parts(*finer, finer_case());
        // A checkpoint of the end is kept: after a restart of the study, the
        // remaining runs need this run again.
        result =
          finer->compute(directory + "/rows/finer_run", command.restart, true);
      }
    catch (const InputError &error)
      {
        result = failed_result(finer_case(), error);
      }
    log.line("Finer run, " + finer_case().name() + ": " +
             describe(result, "finer_run"));
    if (result.status != "done")
      {
        failure_of_finer_run = "the finer run has failed: " + result.message;
        return nullptr;
      }
    take_finer_result(result);
    if (const Simulation *simulation = finer->simulation())
      finer_norms = error_norms(simulation->body().discretization,
                                simulation->body().materials,
                                simulation->displacement(),
                                [](const dealii::Point<3> &) {
                                  return PointDisplacement();
                                })
                      .error;
    return finer.get();
  }

  void
  ConvergenceStudy::compare_with_finer_run(StudyResult    &result,
                                           const StudyRun &run)
  {
    const StudyRun *const finest = finer_run();
    if (finest == nullptr || result.status != "done")
      return;
    const Simulation *fine   = finest->simulation();
    const Simulation *coarse = run.simulation();
    if (fine == nullptr)
      return;
    const double volume      = coarse->body().discretization.volume(),
                 fine_volume = fine->body().discretization.volume();
    // The difference is more than round-off.
    if (!has_warned_of_volume &&
        std::abs(volume - fine_volume) > 1e-9 * fine_volume)
      {
        has_warned_of_volume = true;
        log.warning(fmt::format(
          "{}: the body has {:.6g} m^3, in the finer run {:.6g} m^3: as "
          "refinements follow a curved surface, runs are of bodies of other "
          "shapes, and errors against the finer run leave that out; an exact "
          "solution or quantities do not",
          result.study_case.name(),
          volume,
          fine_volume));
      }
    const TransferredField field(coarse->body().discretization,
                                 coarse->displacement(),
                                 fine->body().discretization);
    result.errors =
      error_norms(fine->body().discretization,
                  fine->body().materials,
                  fine->displacement(),
                  [&](const dealii::Point<3> &x) { return field.value(x); });
    result.errors->reference = finer_norms;
  }
} // namespace corotet
