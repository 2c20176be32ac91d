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

    // The row is filled as a list: rows may have thousands of columns, and
    // operator[] would compare each name with all before it. Names are known to
    // be different (OutputParameters).
    using Row = nlohmann::ordered_json::object_t;

    template <typename Value>
    void
    add(Row &row, const std::string &name, const Value &value)
    {
      row.emplace_back(name, value);
    }

    void
    add_vector(Row &row, const std::string &name, const Tensor<1, 3> &value)
    {
      add(row, name + "_x", value[0]);
      add(row, name + "_y", value[1]);
      add(row, name + "_z", value[2]);
    }

    void
    add_reaction_columns(
      nlohmann::ordered_json                        &row,
      const std::vector<std::string>                &names,
      const std::vector<SupportReactions::Reaction> &reactions)
    {
      AssertDimension(names.size(), reactions.size());
      Row &columns = row.get_ref<Row &>();
      for (unsigned int s = 0; s < names.size(); ++s)
        {
          add_vector(columns, names[s] + "_reaction", reactions[s].force);
          add_vector(columns,
                     names[s] + "_reaction_moment",
                     reactions[s].moment);
        }
    }

    // None if there are no obstacles.
    void
    add_contact_columns(nlohmann::ordered_json &row, const StepRecord &record)
    {
      if (record.contact_forces.empty())
        return;
      Row &columns = row.get_ref<Row &>();
      add(columns, "contact_energy", record.contact_energy);
      add(columns, "friction_work", record.friction_work);
      for (const auto &[obstacle, force] : record.contact_forces)
        add_vector(columns, obstacle + "_contact", force);
    }
  } // namespace

  nlohmann::ordered_json
  history_row(const StepRecord                &record,
              const std::vector<std::string>  &names,
              const std::vector<Tensor<1, 3>> &displacements)
  {
    AssertDimension(names.size(), displacements.size());
    Row row;
    add(row, "step", record.step);
    add(row, "time", record.time);
    add(row, "dt", record.dt);
    add(row, "newton_iterations", record.newton_iterations);
    add(row, "linear_iterations", record.linear_iterations);
    add(row, "kinetic_energy", record.kinetic_energy);
    add(row, "elastic_energy", record.elastic_energy);
    add(row, "dissipated_energy", record.dissipated_energy);
    add(row, "external_work", record.external_work);
    add(row, "energy_balance", record.energy_balance);
    add_vector(row, "momentum", record.momentum);
    add_vector(row, "angular_momentum", record.angular_momentum);
    add(row, "max_displacement", record.max_displacement);
    add(row, "min_det_F", record.min_det_F);
    add(row, "inverted_cells", record.inverted_cells);
    add(row, "wall_time", record.wall_time);
    for (unsigned int p = 0; p < names.size(); ++p)
      add_vector(row, names[p], displacements[p]);
    add(row, "volume", record.volume);
    add_vector(row, "reaction", record.reaction);
    add(row, "degenerate_cells", record.degenerate_cells);
    add(row, "robust_rotations", record.robust_rotations);
    add(row, "clamped_cells", record.clamped_cells);
    add(row, "parts", record.parts);
    add_vector(row, "internal_moment", record.internal_moment);
    add(row, "rejected_steps", record.rejected_steps);
    return row;
  }

  void
  add_stress_columns(nlohmann::ordered_json                           &row,
                     const std::vector<std::string>                   &names,
                     const std::vector<dealii::SymmetricTensor<2, 3>> &stresses)
  {
    AssertDimension(names.size(), stresses.size());
    if (row.is_null())
      row = nlohmann::ordered_json::object();
    Row &columns = row.get_ref<Row &>();
    for (unsigned int p = 0; p < names.size(); ++p)
      {
        const auto components = in_vtk_order(stresses[p]);
        for (unsigned int k = 0; k < components.size(); ++k)
          add(columns,
              names[p] + "_stress_" + vtk_components[k],
              components[k]);
        add(columns, names[p] + "_von_mises", von_mises(stresses[p]));
      }
  }

  nlohmann::ordered_json
  history_example(const OutputParameters         &parameters,
                  const std::vector<std::string> &obstacles)
  {
    const auto names        = names_of(parameters.probe_points());
    const auto stress_names = names_of(parameters.stress_probe_points());
    const auto supports     = names_of(parameters.supports());
    auto row = history_row({}, names, std::vector<Tensor<1, 3>>(names.size()));
    add_stress_columns(row,
                       stress_names,
                       std::vector<dealii::SymmetricTensor<2, 3>>(
                         stress_names.size()));
    add_reaction_columns(
      row, supports, std::vector<SupportReactions::Reaction>(supports.size()));
    StepRecord record;
    for (const std::string &obstacle : obstacles)
      record.contact_forces.emplace_back(obstacle, Tensor<1, 3>());
    add_contact_columns(row, record);
    return row;
  }

  HistoryColumns::HistoryColumns(const OutputParameters &parameters,
                                 const Simulation       &simulation,
                                 Log                    &log)
    : probes(parameters.probe_points(), simulation.body().discretization, &log)
    , reactions(parameters.supports(),
                simulation.body(),
                simulation.ground_boundaries())
  {
    if (const auto points = parameters.stress_probe_points(); !points.empty())
      stress_probes.emplace(points,
                            simulation.body().discretization,
                            parameters.raw_stress_at_probes,
                            &log);
  }

  nlohmann::ordered_json
  HistoryColumns::row(const Snapshot &state) const
  {
    auto result = history_row(state.record,
                              probes.names(),
                              probes.displacements(state.displacement));
    if (stress_probes)
      add_stress_columns(result,
                         stress_probes->names(),
                         stress_probes->stresses(state.stress()));
    if (!reactions.names().empty())
      add_reaction_columns(result,
                           reactions.names(),
                           reactions.reactions(state));
    add_contact_columns(result, state.record);
    return result;
  }

  HistoryWriter::HistoryWriter(const std::string    &directory,
                               const HistoryColumns &columns)
    : path(directory + "/history.csv")
    , columns(columns)
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
    // The checkpoint's state may be later than the last row.
    std::string text = row->dump();
    archive.transfer("history_row", text);
    // Parsing thousands of columns takes a while.
    if (archive.is_reading())
      *row = nlohmann::ordered_json::parse(text);
  }

  void
  HistoryWriter::resume(const Snapshot &state)
  {
    on_root(state.discretization.communicator(),
            [&] { continue_file(path, saved_size, "the history", file); });
  }

  void
  HistoryWriter::write_row(const Snapshot &state, const bool with_names)
  {
    *row = columns.row(state);
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
