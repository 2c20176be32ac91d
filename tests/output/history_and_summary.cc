// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// history.csv and summary.json: the columns and keys that scripts rely on, and
// numbers that read back as the same doubles.

#include <corotet/base/version.h>
#include <corotet/output/history_writer.h>
#include <corotet/output/summary_writer.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <sstream>

#include "support.h"

using namespace corotet;
using namespace test_output;

namespace
{
  const std::string header =
    "step,time,dt,newton_iterations,linear_iterations,kinetic_energy,"
    "elastic_energy,dissipated_energy,external_work,energy_balance,momentum_x,"
    "momentum_y,momentum_z,angular_momentum_x,angular_momentum_y,"
    "angular_momentum_z,max_displacement,min_det_F,inverted_cells,wall_time,"
    "corner_x,corner_y,corner_z,volume,reaction_x,reaction_y,reaction_z,"
    "degenerate_cells,robust_rotations,clamped_cells,parts,"
    "internal_moment_x,internal_moment_y,internal_moment_z,rejected_steps";

  const std::vector<ProbePoint> corner{{"corner", {1, 0.5, 0.25}}};

  std::vector<std::string>
  lines_of(const std::string &file)
  {
    std::istringstream       text(content_of(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);)
      lines.push_back(line);
    return lines;
  }

  std::vector<double>
  numbers_of(const std::string &line)
  {
    std::istringstream  text(line);
    std::vector<double> numbers;
    for (std::string word; std::getline(text, word, ',');)
      numbers.push_back(std::strtod(word.c_str(), nullptr));
    return numbers;
  }

  RunSummary
  some_summary()
  {
    RunSummary summary;
    summary.status           = "done";
    summary.ranks            = 2;
    summary.degree           = 3;
    summary.cells            = 96;
    summary.nodes            = 637;
    summary.unknowns         = 1911;
    summary.mesh_volume      = 0.125;
    summary.total_mass       = std::nan("");
    summary.steps            = 1;
    summary.end_time         = 0.1;
    summary.wall_times.solve = 0.25;
    summary.total_wall_time  = 1;
    return summary;
  }
} // namespace

// The columns are those of the documentation. The probe is at a node, where its
// displacement is the field's own value.
TEST(HistoryWriter, RowsReadBackExactly)
{
  const ScratchFolder scratch;
  const std::string   file = scratch.path + "/history.csv";
  ModelBody           body(2);
  HistoryWriter       writer(scratch.path, Probes(corner, body.discretization));
  EXPECT_TRUE(writer.last_row().empty());
  body.show(writer, 0, 0, false);
  wait_for_all();
  EXPECT_EQ(lines_of(file).size(), 2u) << "row 0 waits for row 1";
  body.show(writer, 1, 1. / 3., true);
  wait_for_all();
  const auto lines = lines_of(file);
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_EQ(lines[0], header);

  const StepRecord record = ModelBody::record(1, 1. / 3.);
  const auto u = displacement_field(dealii::Point<3>(1, 0.5, 0.25), 1. / 3.);
  std::vector<double> values = numbers_of(lines[2]);
  ASSERT_EQ(values.size(), 35u);
  // The tolerance is the round-off of shape functions.
  for (unsigned int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(values[20 + c], u[c], 1e-15);
      EXPECT_EQ(values[20 + c],
                writer.last_row()[std::string("corner_") + "xyz"[c]]);
      values[20 + c] = 0;
    }
  EXPECT_EQ(values,
            (std::vector<double>{1,
                                 1. / 3.,
                                 0.1,
                                 2,
                                 31,
                                 record.kinetic_energy,
                                 record.elastic_energy,
                                 0,
                                 record.external_work,
                                 0,
                                 0,
                                 std::sqrt(2.),
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,
                                 1,
                                 0,
                                 0.5,
                                 0,
                                 0,
                                 0,
                                 0.125,
                                 0,
                                 0,
                                 -std::sqrt(3.),
                                 0,
                                 0,
                                 0,
                                 1,
                                 0,
                                 0,
                                 0,
                                 0}));
}

// /dev/full is like a full disk.
TEST(HistoryWriter, FullDiskIsAnError)
{
  const ScratchFolder scratch;
  const std::string   file = scratch.path + "/history.csv";
  if (on_rank_0())
    std::filesystem::create_symlink("/dev/full", file);
  ModelBody     body(1);
  HistoryWriter writer(scratch.path, Probes({}, body.discretization));
  EXPECT_EQ(message_of<MachineError>([&] { body.show(writer, 0, 0, false); }),
            file + ": the history cannot be written: No space left on device");
}

TEST(HistoryWriter, MissingFolderIsAnError)
{
  ModelBody     body(1);
  HistoryWriter writer("/proc/corotet", Probes({}, body.discretization));
  EXPECT_EQ(message_of<MachineError>([&] { body.show(writer, 0, 0, false); }),
            "/proc/corotet/history.csv: the history cannot be written: No such "
            "file or directory");
}

// The summary has all keys in the documentation's order; values that are not
// numbers are null.
TEST(SummaryWriter, HasAllKeys)
{
  const ScratchFolder scratch;
  ModelBody           body(1);
  HistoryWriter history(scratch.path, Probes(corner, body.discretization));
  SummaryWriter writer(scratch.path, history, MPI_COMM_WORLD);
  body.show(history, 0, 0, false);
  body.show(history, 1, 0.1, true);
  writer.finish(some_summary());
  wait_for_all();

  const auto json =
    nlohmann::ordered_json::parse(content_of(scratch.path + "/summary.json"));
  std::string keys;
  for (const auto &[key, value] : json.items())
    keys += (keys.empty() ? "" : ",") + key;
  EXPECT_EQ(
    keys,
    "status,version,git_revision,dealii_version,ranks,cells,nodes,dofs,"
    "degree,mesh_volume,total_mass,steps,end_time,preconditioner_builds,"
    "final,wall_time,peak_memory_bytes");
  keys.clear();
  for (const auto &[key, value] : json["final"].items())
    keys += (keys.empty() ? "" : ",") + key;
  EXPECT_EQ(keys, header);
  EXPECT_EQ(json["final"], history.last_row());
  EXPECT_EQ(json["final"]["step"], 1);
  EXPECT_EQ(json["status"], "done");
  EXPECT_EQ(json["version"], version);
  EXPECT_EQ(json["dofs"], 1911);
  EXPECT_TRUE(json["total_mass"].is_null());
  EXPECT_EQ(json["wall_time"],
            nlohmann::ordered_json::parse(
              R"({"setup": 0.0, "read": 0.0, "partition": 0.0, "assembly": 0.0,
              "solve": 0.25, "output": 0.0, "total": 1.0})"));
  // A process with deal.II needs megabytes of memory, on each rank.
  EXPECT_GT(json["peak_memory_bytes"].get<double>(), 1e6 * n_ranks());
  EXPECT_FALSE(std::filesystem::exists(scratch.path + "/summary.json.tmp"));
}

// A run that fails before its first state has a summary, too.
TEST(SummaryWriter, TellsWhyARunFailed)
{
  const ScratchFolder scratch;
  ModelBody           body(1);
  HistoryWriter       history(scratch.path, Probes({}, body.discretization));
  SummaryWriter       writer(scratch.path, history, MPI_COMM_WORLD);
  RunSummary          summary = some_summary();
  summary.status              = "failed";
  summary.message             = "no convergence";
  writer.finish(summary);
  wait_for_all();
  const auto json =
    nlohmann::json::parse(content_of(scratch.path + "/summary.json"));
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["message"], "no convergence");
  EXPECT_TRUE(json["final"].is_object() && json["final"].empty());
}

TEST(SummaryWriter, MissingFolderIsAnError)
{
  ModelBody     body(1);
  HistoryWriter history("/proc/corotet", Probes({}, body.discretization));
  SummaryWriter writer("/proc/corotet", history, MPI_COMM_WORLD);
  EXPECT_EQ(message_of<MachineError>([&] { writer.finish(some_summary()); }),
            "/proc/corotet/summary.json: the summary cannot be written (is the "
            "disk full, or permission missing?)");
}
