// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/studies/verification.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

namespace corotet
{
  namespace
  {
    // A row of the table: quantity, computed, reference, error, tolerance,
    // pass.
    using Cells = std::array<std::string, 6>;

    const Cells header = {
      {"quantity", "computed", "reference", "error", "tolerance", "pass"}};

    Cells
    cells_of(const CheckResult &result)
    {
      // The computed value and the reference have enough digits to read the
      // same double back.
      return {
        {result.name,
         fmt::format("{}", result.computed),
         fmt::format("{}", result.reference),
         fmt::format("{:+.3g}{}", result.error, result.relative ? " %" : ""),
         result.tolerance,
         result.passed ? "yes" : "no"}};
    }

    void
    show(const std::vector<CheckResult> &results, Log &log)
    {
      std::size_t width = header[0].size();
      for (const CheckResult &result : results)
        width = std::max(width, result.name.size());
      const auto show_line = [&](const Cells &cells) {
        log.line(fmt::format("{:{}}  {:>12}  {:>12}  {:>11}  {:>9}  {}",
                             cells[0],
                             width,
                             cells[1],
                             cells[2],
                             cells[3],
                             cells[4],
                             cells[5]));
      };
      show_line(header);
      for (const CheckResult &result : results)
        {
          Cells cells = cells_of(result);
          cells[1]    = fmt::format("{:.7g}", result.computed);
          cells[2]    = fmt::format("{:.7g}", result.reference);
          show_line(cells);
        }
    }

    void
    write(const std::string              &name,
          const std::string              &path,
          const std::vector<CheckResult> &results)
    {
      const auto csv_line = [](const std::string &first, const Cells &cells) {
        return first + "," + join({cells.begin(), cells.end()}, ",") + "\n";
      };
      std::string text  = csv_line("case", header);
      std::string first = name;
      if (first.find_first_of(",\"\n") != std::string::npos)
        {
          for (std::size_t i = first.find('"'); i != std::string::npos;
               i             = first.find('"', i + 2))
            first.insert(i, 1, '"');
          first = '"' + first + '"';
        }
      for (const CheckResult &result : results)
        text += csv_line(first, cells_of(result));
      write_whole_file(path, text, "the comparison");
    }
  } // namespace

  void
  Verification::declare_parameters(dealii::ParameterHandler &prm)
  {
    const dealii::Patterns::Anything anything;
    prm.add_parameter(
      "Checks",
      checks_text,
      "Comparisons of the results with references; if one fails, so does the "
      "run. 'NAME: STATISTIC FORMULA where CONDITION = REFERENCE +- TOLERANCE; "
      "...': the STATISTIC is the first, last, min, max, mean or range (max - "
      "min) of a FORMULA in the columns of history.csv (of modes.csv or "
      "study.csv, as Type has it) over the rows where a CONDITION holds, or "
      "over all rows without 'where'. A TOLERANCE may be in %; '< REFERENCE' "
      "or '> REFERENCE' is a bound.",
      anything);
    prm.add_parameter("Source",
                      source,
                      "Source of the reference values, such as a book or a "
                      "paper; needed with checks.",
                      anything);
    prm.add_parameter("Tolerance reason",
                      tolerance_reason,
                      "Reason for the size of the tolerances; needed with "
                      "checks.",
                      anything);
  }

  void
  Verification::initialize(const std::vector<std::string> &columns)
  {
    const std::vector<std::string> texts =
      split_outside_brackets(checks_text, ';');
    if (texts == std::vector<std::string>{""})
      return;
    if (source.empty())
      throw InputError("Verification/Source",
                       "it is empty; checks need a source of their references");
    if (tolerance_reason.empty())
      throw InputError("Verification/Tolerance reason",
                       "it is empty; checks need a reason of their tolerances");
    std::set<std::string> names;
    for (const std::string &text : texts)
      {
        checks.emplace_back(text, columns);
        if (!names.insert(checks.back().name()).second)
          throw InputError("Verification/Checks",
                           fmt::format("two checks are called '{}'; each name "
                                       "must be used once",
                                       shortened(checks.back().name())));
      }
  }

  void
  Verification::compare(const std::string &name,
                        const std::string &directory,
                        const std::string &file,
                        const MPI_Comm     comm,
                        Log               &log) const
  {
    if (checks.empty())
      return;
    on_root(comm, [&] {
      const ResultTable table = read_result_table(directory + "/" + file);
      std::vector<CheckResult> results;
      for (const Check &check : checks)
        results.push_back(check.evaluate(table));
      show(results, log);
      write(name, directory + "/verification.csv", results);
      const auto n_failed =
        std::count_if(results.begin(), results.end(), [](const auto &result) {
          return !result.passed;
        });
      if (n_failed > 0)
        throw ComputationError(fmt::format("{} of {} checks failed; see {}",
                                           n_failed,
                                           results.size(),
                                           directory + "/verification.csv"));
    });
  }
} // namespace corotet
