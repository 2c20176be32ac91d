// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/whole_file.h>
#include <corotet/output/csv.h>
#include <corotet/output/history_writer.h>
#include <corotet/output/stress_tables.h>

#include <nlohmann/json.hpp>

#include <cerrno>
#include <system_error>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    void
    add_vector(nlohmann::ordered_json &row,
               const std::string      &name,
               const Tensor<1, 3>     &value)
    {
      row[name + "_x"] = value[0];
      row[name + "_y"] = value[1];
      row[name + "_z"] = value[2];
    }
  } // namespace

  nlohmann::ordered_json
  history_row(const StepRecord                &record,
              const std::vector<std::string>  &names,
              const std::vector<Tensor<1, 3>> &displacements)
  {
    AssertDimension(names.size(), displacements.size());
    nlohmann::ordered_json row;
    row["step"]              = record.step;
    row["time"]              = record.time;
    row["dt"]                = record.dt;
    row["newton_iterations"] = record.newton_iterations;
    row["linear_iterations"] = record.linear_iterations;
    row["kinetic_energy"]    = record.kinetic_energy;
    row["elastic_energy"]    = record.elastic_energy;
    row["dissipated_energy"] = record.dissipated_energy;
    row["external_work"]     = record.external_work;
    row["energy_balance"]    = record.energy_balance;
    add_vector(row, "momentum", record.momentum);
    add_vector(row, "angular_momentum", record.angular_momentum);
    row["max_displacement"] = record.max_displacement;
    row["min_det_F"]        = record.min_det_F;
    row["inverted_cells"]   = record.inverted_cells;
    row["wall_time"]        = record.wall_time;
    for (unsigned int p = 0; p < names.size(); ++p)
      add_vector(row, names[p], displacements[p]);
    row["volume"] = record.volume;
    add_vector(row, "reaction", record.reaction);
    row["degenerate_cells"] = record.degenerate_cells;
    row["robust_rotations"] = record.robust_rotations;
    row["clamped_cells"]    = record.clamped_cells;
    row["parts"]            = record.parts;
    add_vector(row, "internal_moment", record.internal_moment);
    row["rejected_steps"] = record.rejected_steps;
    return row;
  }

  void
  add_stress_columns(nlohmann::ordered_json                           &row,
                     const std::vector<std::string>                   &names,
                     const std::vector<dealii::SymmetricTensor<2, 3>> &stresses)
  {
    AssertDimension(names.size(), stresses.size());
    for (unsigned int p = 0; p < names.size(); ++p)
      {
        const auto components = in_vtk_order(stresses[p]);
        for (unsigned int k = 0; k < components.size(); ++k)
          row[names[p] + "_stress_" + vtk_components[k]] = components[k];
        row[names[p] + "_von_mises"] = von_mises(stresses[p]);
      }
  }

  nlohmann::ordered_json
  history_example(const OutputParameters &parameters)
  {
    const auto names        = names_of(parameters.probe_points());
    const auto stress_names = names_of(parameters.stress_probe_points());
    auto row = history_row({}, names, std::vector<Tensor<1, 3>>(names.size()));
    add_stress_columns(row,
                       stress_names,
                       std::vector<dealii::SymmetricTensor<2, 3>>(
                         stress_names.size()));
    return row;
  }

  HistoryWriter::HistoryWriter(const std::string                 &directory,
                               const Probes                      &probes,
                               const std::optional<StressProbes> &stress_probes)
    : path(directory + "/history.csv")
    , probes(probes)
    , stress_probes(stress_probes)
    , row(std::make_unique<nlohmann::ordered_json>(
        nlohmann::ordered_json::object()))
  {}

  HistoryWriter::~HistoryWriter() = default;

  void
  HistoryWriter::start(const Snapshot &initial)
  {
    write_row(initial, true);
  }

  void
  HistoryWriter::step(const Snapshot &state)
  {
    write_row(state, false);
  }

  void
  HistoryWriter::transfer(Archive &archive)
  {
    if (!archive.is_reading())
      saved_size = file.tellp();
    archive.transfer("history_size", saved_size);
  }

  void
  HistoryWriter::resume(const Snapshot &state)
  {
    make_row(state);
    on_root(state.discretization.communicator(),
            [&] { continue_file(path, saved_size, "the history", file); });
  }

  void
  HistoryWriter::make_row(const Snapshot &state)
  {
    *row = history_row(state.record,
                       probes.names(),
                       probes.displacements(state.displacement));
    if (stress_probes)
      add_stress_columns(*row,
                         stress_probes->names(),
                         stress_probes->stresses(state.stress()));
  }

  void
  HistoryWriter::write_row(const Snapshot &state, const bool with_names)
  {
    make_row(state);
    on_root(state.discretization.communicator(), [&] {
      errno = 0;
      if (with_names)
        {
          file.open(path);
          file << csv_line(*row, true);
        }
      file << csv_line(*row, false) << std::flush;
      if (!file)
        throw MachineError(
          path + ": the history cannot be written: " +
          std::generic_category().message(errno == 0 ? EIO : errno));
    });
  }
} // namespace corotet
