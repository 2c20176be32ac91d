// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/base/whole_file.h>
#include <corotet/output/csv.h>
#include <corotet/output/modes_writer.h>
#include <corotet/output/stress_points_writer.h>
#include <corotet/output/summary_writer.h>
#include <corotet/output/vtkhdf_writer.h>

#include <nlohmann/json.hpp>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    nlohmann::ordered_json
    table_row(const unsigned int               number,
              const Mode                      &mode,
              const double                     total_mass,
              const std::vector<std::string>  &names,
              const std::vector<Tensor<1, 3>> &displacements)
    {
      nlohmann::ordered_json row;
      row["mode"]              = number;
      row["frequency"]         = mode.frequency;
      row["angular_frequency"] = mode.angular_frequency;
      row["eigenvalue"]        = mode.eigenvalue;
      row["residual"]          = mode.residual;
      row["modal_mass"]        = mode.modal_mass;
      const auto add = [&](const std::string &name, const Tensor<1, 3> &value) {
        for (unsigned int a = 0; a < 3; ++a)
          row[name + "_" + "xyz"[a]] = value[a];
      };
      add("effective_mass", mode.effective_mass);
      add("mass_share", mode.effective_mass / total_mass);
      for (unsigned int p = 0; p < names.size(); ++p)
        add(names[p], displacements[p]);
      return row;
    }
  } // namespace

  nlohmann::ordered_json
  modes_example(const OutputParameters &parameters)
  {
    const auto names        = names_of(parameters.probe_points());
    const auto stress_names = names_of(parameters.stress_probe_points());
    auto       row =
      table_row(0, {}, 1, names, std::vector<Tensor<1, 3>>(names.size()));
    add_stress_columns(row,
                       stress_names,
                       std::vector<dealii::SymmetricTensor<2, 3>>(
                         stress_names.size()));
    return row;
  }

  ModesWriter::ModesWriter(const OutputParameters &parameters,
                           const std::string      &directory,
                           ModalAnalysis          &analysis,
                           Log                    &log)
    : directory(directory)
    , analysis(analysis)
    , probes(parameters.probe_points(), analysis.body().discretization, &log)
    , stress_probes(parameters.stress_probe_points(),
                    analysis.body().discretization,
                    parameters.raw_stress_at_probes,
                    &log)
    , stress(analysis.body().stress_field())
    , with_stress_at_nodes(parameters.has_stress_at_nodes())
    , with_stress_at_points(parameters.has_stress_at_points())
  {}

  void
  ModesWriter::write(const std::string &failure)
  {
    if (!analysis.modes().empty())
      {
        ScopedTimer timer(analysis.wall_times.output);
        write_table();
        write_shapes();
      }
    RunSummary summary = analysis.summary();
    summary.status     = failure.empty() ? "done" : "failed";
    summary.message    = failure;

    nlohmann::ordered_json results;
    results["modes"]       = analysis.modes().size();
    results["frequencies"] = nlohmann::ordered_json::array();
    for (const Mode &mode : analysis.modes())
      results["frequencies"].push_back(mode.frequency);
    write_summary(directory,
                  summary,
                  results,
                  analysis.body().discretization.communicator());
  }

  void
  ModesWriter::write_table()
  {
    const double total_mass = analysis.summary().total_mass;
    std::string  text;
    for (unsigned int i = 0; i < analysis.modes().size(); ++i)
      {
        const Mode &mode = analysis.modes()[i];
        auto        row  = table_row(i + 1,
                             mode,
                             total_mass,
                             probes.names(),
                             probes.displacements(mode.shape));
        if (!stress_probes.names().empty())
          {
            stress.set_displacement(mode.shape);
            add_stress_columns(row,
                               stress_probes.names(),
                               stress_probes.stresses(stress));
          }
        if (i == 0)
          text += csv_line(row, true);
        text += csv_line(row, false);
      }
    on_root(analysis.body().discretization.communicator(), [&] {
      write_whole_file(directory + "/modes.csv", text, "the modes");
    });
  }

  void
  ModesWriter::write_shapes()
  {
    std::vector<std::unique_ptr<Observer>> writers;
    writers.push_back(
      std::make_unique<VtkhdfWriter>(directory, 0, 32, with_stress_at_nodes));
    if (with_stress_at_points)
      writers.push_back(std::make_unique<StressPointsWriter>(directory, 0));
    for (unsigned int i = 0; i < analysis.modes().size(); ++i)
      {
        const Mode &mode = analysis.modes()[i];
        StepRecord  record;
        record.step = i + 1;
        record.time = i + 1;
        // The largest velocity of a vibration with this amplitude.
        Vector velocity(mode.shape);
        velocity *= mode.angular_frequency;
        velocity.update_ghost_values();
        stress.set_displacement(mode.shape);
        const Snapshot snapshot{
          analysis.body().discretization,
          record,
          mode.shape,
          velocity,
          [&] { return analysis.body().elasticity.cell_results(mode.shape); },
          i + 1 == analysis.modes().size(),
          [&]() -> StressField & { return stress; },
          {}};
        for (const auto &writer : writers)
          if (i == 0)
            writer->start(snapshot);
          else
            writer->step(snapshot);
      }
  }
} // namespace corotet
