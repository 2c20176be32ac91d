// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/output/output_directory.h>
#include <corotet/output/result_size.h>
#include <corotet/output/stress_tables.h>

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

namespace corotet
{
  namespace
  {
    // The numbers of rows of the history, and of states of the time series.
    std::pair<double, double>
    numbers_of_records(const OutputParameters &parameters,
                       const double            n_steps,
                       const double            duration)
    {
      const double interval   = parameters.time_between_results;
      const double n_results  = interval > 0 ? duration / interval : 0;
      const double n_rows     = n_steps / parameters.steps_between_rows;
      const double between    = parameters.time_between_states(duration);
      const double n_intended = between > 0 ? duration / between : n_rows;
      const double n_all      = std::max(n_rows, std::min(n_results, n_steps));
      return {n_all, std::min(n_intended, n_all)};
    }

    // The least size of so many rows and states [byte].
    double
    size_of_records(const OutputParameters &parameters,
                    const Body             &body,
                    const double            n_rows,
                    const double            n_states)
    {
      // A state has numbers of 64 bits: displacement and velocity at nodes, and
      // three numbers for each cell; with stress at quadrature points, also
      // displacements there. A row of the history is text, with 12 characters
      // or more for each nonzero number.
      double n_of_stress = 0;
      for (const VtkhdfSeries::Table &table : StressTables::tables())
        n_of_stress += std::max(1U, static_cast<unsigned int>(table.n_columns));
      const double n_points =
        body.elasticity.reference_element().stiffness_rule.weights.size();
      const double of_node =
        8 * (6 + (parameters.has_stress_at_nodes() ? n_of_stress : 0));
      const double of_cell = 8 * (3 + (parameters.has_stress_at_points() ?
                                         n_points * (3 + n_of_stress) :
                                         0));
      const double of_row  = 12 * 20;
      return n_rows * of_row +
             n_states * (of_node * body.discretization.n_global_nodes() +
                         of_cell * body.discretization.n_global_cells());
    }
  } // namespace

  void
  warn_of_size(const OutputParameters &parameters,
               const std::string      &directory,
               const Body             &body,
               const double            n_steps,
               const double            duration,
               Log                    &log)
  {
    constexpr double gigabyte = 1e9;
    constexpr double many     = 100 * gigabyte;
    const auto [rows, states] =
      numbers_of_records(parameters, n_steps, duration);
    const double size = size_of_records(parameters, body, rows, states);
    const double free = from_root(body.discretization.communicator(), [&] {
      return static_cast<double>(
        std::filesystem::space(existing_place(directory)).available);
    });
    if (size <= std::min(many, free))
      return;
    log.warning(fmt::format(
      "Output: results will have some {:.3g} GB, and the disk has {:.3g} GB "
      "left: {:.3g} rows of history.csv and {:.3g} states of the time series; "
      "Steps between rows and Time between results make them fewer",
      size / gigabyte,
      free / gigabyte,
      rows,
      states));
  }
} // namespace corotet
