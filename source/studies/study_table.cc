// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/csv.h>
#include <corotet/studies/study_table.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  using Json = nlohmann::ordered_json;

  namespace
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();

    double
    order(const double error_1,
          const double error_2,
          const double h_1,
          const double h_2)
    {
      const double value = std::log(error_1 / error_2) / std::log(h_1 / h_2);
      return std::isfinite(value) ? value : nan;
    }

    // Whether b differs from a in the refinement at most.
    bool
    is_refinement_of(const StudyCase &b, StudyCase a)
    {
      a.refinements = b.refinements;
      return a == b;
    }

    bool
    is_shorter_step_of(const StudyCase &b, StudyCase a)
    {
      if (!a.time_step || !b.time_step || *b.time_step >= *a.time_step)
        return false;
      a.time_step = b.time_step;
      return a == b;
    }

    std::string
    order_text(const double value)
    {
      return std::isnan(value) ? "" : fmt::format("{:.2f}", value);
    }
  } // namespace

  StudyTable::StudyTable(
    const std::vector<StudyResult>               &results,
    const std::vector<StudyParameters::Quantity> &quantities)
    : results(results)
    , quantities(quantities)
  {
    // Columns depend on the cases alone, not on the numbers in them.
    for (const StudyResult &fine : results)
      for (const StudyResult &coarse : results)
        if (is_shorter_step_of(fine.study_case, coarse.study_case))
          has_orders_in_time = true;
    const auto norm = [&](const std::string &name, double FieldNorms::*norm) {
      std::vector<double> references, values;
      for (const StudyResult &result : results)
        {
          references.push_back(result.errors ? result.errors->reference.*norm :
                                               nan);
          values.push_back(result.errors ? result.errors->error.*norm : nan);
        }
      add_error(name, references, values);
    };
    if (std::any_of(results.begin(), results.end(), [](const auto &result) {
          return result.errors.has_value();
        }))
      {
        norm("L2", &FieldNorms::L2);
        norm("H1", &FieldNorms::H1);
        norm("energy", &FieldNorms::energy);
      }
    for (unsigned int i = 0; i < quantities.size(); ++i)
      if (quantities[i].reference)
        {
          std::vector<double> values;
          for (const StudyResult &result : results)
            values.push_back(
              std::abs(result.quantities[i] - *quantities[i].reference));
          add_error(quantities[i].name,
                    std::vector<double>(results.size(),
                                        std::abs(*quantities[i].reference)),
                    values);
        }
  }

  void
  StudyTable::add_error(const std::string         &name,
                        const std::vector<double> &references,
                        const std::vector<double> &values)
  {
    Error error{name, references, values, {}, {}};
    error.orders.assign(values.size(), nan);
    error.orders_in_time.assign(values.size(), nan);
    // Round-off, as of a run that is compared with itself, has no order.
    double largest = 0;
    for (const double value : values)
      largest = std::max(largest, value);
    const double round_off = 1e-12 * largest;
    for (unsigned int i = 0; i < values.size(); ++i)
      // The last assignment is from the nearest such result before this one.
      for (unsigned int j = 0; j < i; ++j)
        {
          const StudyCase &coarse = results[j].study_case;
          const StudyCase &fine   = results[i].study_case;
          if (values[i] <= round_off)
            continue;
          if (is_refinement_of(fine, coarse))
            error.orders[i] =
              order(values[j], values[i], results[j].h, results[i].h);
          if (is_shorter_step_of(fine, coarse))
            error.orders_in_time[i] = order(values[j],
                                            values[i],
                                            results[j].mean_time_step,
                                            results[i].mean_time_step);
        }
    errors.push_back(error);
  }

  std::vector<std::string>
  StudyTable::not_converging() const
  {
    // Smaller errors may be those of solvers.
    constexpr double         least_error = 1e-6, least_order = 0.5;
    std::vector<std::string> lines;
    for (const Error &error : errors)
      for (unsigned int i = 0; i < results.size(); ++i)
        {
          const StudyCase &one       = results[i].study_case;
          const bool       is_finest = std::none_of(
            results.begin(), results.end(), [&](const auto &other) {
              return is_refinement_of(other.study_case, one) &&
                     other.study_case.refinements > one.refinements;
            });
          if (is_finest && error.orders[i] < least_order &&
              error.values[i] > least_error * error.references[i])
            lines.push_back(fmt::format(
              "the error '{}' does not become small with finer cells: its last "
              "order is {:.2f} with degree {}",
              error.name,
              error.orders[i],
              one.degree));
        }
    return lines;
  }

  std::string
  StudyTable::csv() const
  {
    std::string text;
    for (unsigned int i = 0; i < results.size(); ++i)
      {
        const StudyResult &result = results[i];
        const StudyCase   &one    = result.study_case;
        Json               row;
        row["degree"]      = one.degree;
        row["refinements"] = one.refinements;
        if (one.time_step)
          {
            row["time_step"]      = *one.time_step;
            row["mean_time_step"] = result.mean_time_step;
          }
        if (one.mass)
          row["mass"] = *one.mass;
        if (one.rotation)
          row["rotation"] = *one.rotation;
        row["status"] = result.status;
        row["cells"]  = result.cells;
        row["nodes"]  = result.nodes;
        row["dofs"]   = result.unknowns;
        row["h"]      = result.h;
        if (!errors.empty() && errors[0].name == "L2")
          {
            const ErrorNorms norms  = result.errors.value_or(ErrorNorms());
            row["L2_reference"]     = norms.reference.L2;
            row["H1_reference"]     = norms.reference.H1;
            row["energy_reference"] = norms.reference.energy;
          }
        for (unsigned int k = 0; k < quantities.size(); ++k)
          row[quantities[k].name] = result.quantities[k];
        for (const Error &error : errors)
          {
            row[error.name + "_error"] = error.values[i];
            row[error.name + "_order"] = error.orders[i];
            if (has_orders_in_time)
              row[error.name + "_order_in_time"] = error.orders_in_time[i];
          }
        row["steps"]             = result.steps;
        row["newton_iterations"] = result.newton_iterations;
        row["linear_iterations"] = result.linear_iterations;
        row["setup_time"]        = result.wall_times.setup;
        row["assembly_time"]     = result.wall_times.assembly;
        row["solve_time"]        = result.wall_times.solve;
        row["wall_time"]         = result.total_wall_time;
        row["peak_memory_bytes"] = result.peak_memory_bytes;
        if (i == 0)
          text += csv_line(row, true);
        text += csv_line(row, false);
      }
    return text;
  }

  std::vector<std::vector<std::string>>
  StudyTable::cells() const
  {
    const StudyCase         &first = results.front().study_case;
    std::vector<std::string> titles{"degree", "refinements"};
    if (first.time_step)
      titles.emplace_back("time step");
    // Whether some steps have another length than the given one.
    const bool has_mean_steps =
      std::any_of(results.begin(), results.end(), [](const auto &result) {
        return result.study_case.time_step && result.steps > 0 &&
               std::abs(result.mean_time_step - *result.study_case.time_step) >
                 1e-6 * result.mean_time_step;
      });
    if (has_mean_steps)
      titles.emplace_back("mean step");
    if (first.mass)
      titles.emplace_back("mass");
    if (first.rotation)
      titles.emplace_back("rotation");
    for (const char *title : {"cells", "dofs", "h"})
      titles.emplace_back(title);
    for (const auto &quantity : quantities)
      titles.push_back(quantity.name);
    for (const Error &error : errors)
      {
        titles.push_back(error.name + " error");
        titles.emplace_back("order");
        if (has_orders_in_time)
          titles.emplace_back("in time");
      }
    for (const char *title : {"Newton", "linear", "time [s]"})
      titles.emplace_back(title);

    std::vector<std::vector<std::string>> table{titles};
    for (unsigned int i = 0; i < results.size(); ++i)
      {
        const StudyResult       &result = results[i];
        const StudyCase         &one    = result.study_case;
        std::vector<std::string> row{fmt::format("{}", one.degree),
                                     fmt::format("{}", one.refinements)};
        if (one.time_step)
          row.push_back(fmt::format("{:.4g}", *one.time_step));
        if (has_mean_steps)
          row.push_back(fmt::format("{:.4g}", result.mean_time_step));
        if (one.mass)
          row.push_back(*one.mass);
        if (one.rotation)
          row.push_back(*one.rotation);
        row.push_back(fmt::format("{}", result.cells));
        row.push_back(fmt::format("{}", result.unknowns));
        row.push_back(fmt::format("{:.4g}", result.h));
        for (const double value : result.quantities)
          row.push_back(fmt::format("{:.7g}", value));
        for (const Error &error : errors)
          {
            row.push_back(std::isnan(error.values[i]) ?
                            result.status :
                            fmt::format("{:.3e}", error.values[i]));
            row.push_back(order_text(error.orders[i]));
            if (has_orders_in_time)
              row.push_back(order_text(error.orders_in_time[i]));
          }
        row.push_back(fmt::format("{}", result.newton_iterations));
        row.push_back(fmt::format("{}", result.linear_iterations));
        row.push_back(fmt::format("{:.2f}", result.total_wall_time));
        table.push_back(row);
      }
    return table;
  }

  std::vector<std::string>
  StudyTable::lines() const
  {
    const auto               table = cells();
    std::vector<std::size_t> widths(table[0].size(), 0);
    for (const auto &row : table)
      for (unsigned int c = 0; c < row.size(); ++c)
        widths[c] = std::max(widths[c], row[c].size());
    std::vector<std::string> result;
    for (const auto &row : table)
      {
        std::string line;
        for (unsigned int c = 0; c < row.size(); ++c)
          line += fmt::format("{:>{}}", row[c], widths[c] + (c == 0 ? 0 : 2));
        result.push_back(line);
      }
    return result;
  }

  std::string
  StudyTable::latex() const
  {
    const auto  table = cells();
    std::string text  = fmt::format("\\begin{{tabular}}{{{}}}\n\\toprule\n",
                                   std::string(table[0].size(), 'r'));
    for (unsigned int r = 0; r < table.size(); ++r)
      {
        std::string line;
        for (unsigned int c = 0; c < table[r].size(); ++c)
          for (const char character : (c == 0 ? "" : " & ") + table[r][c])
            line +=
              character == '_' ? std::string("\\_") : std::string(1, character);
        text += line + " \\\\\n" + (r == 0 ? "\\midrule\n" : "");
      }
    return text + "\\bottomrule\n\\end{tabular}\n";
  }
} // namespace corotet
