// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The time series for ParaView. check_vtkhdf.py compares what VTK's own reader
// reads with what was written, and tells what it checks.

#include <corotet/output/history_writer.h>
#include <corotet/output/observers.h>
#include <corotet/output/vtkhdf_writer.h>

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "support.h"

using namespace corotet;
using namespace test_output;
namespace fs = std::filesystem;

namespace
{
  std::vector<std::string>
  files_in(const std::string &folder)
  {
    std::vector<std::string> names;
    for (const auto &entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  std::vector<std::unique_ptr<Observer>>
  observers_of(const OutputParameters &parameters,
               const std::string      &directory,
               ModelBody              &body)
  {
    return make_observers(parameters,
                          directory,
                          Probes(parameters.probe_points(),
                                 body.discretization),
                          MPI_COMM_WORLD,
                          0,
                          1,
                          body.log);
  }
} // namespace

// VTK's order is a permutation of all nodes that keeps the vertices.
TEST(VtkhdfWriter, NodeOrderIsAPermutation)
{
  EXPECT_EQ(vtk_node_order(1), (std::vector<unsigned int>{0, 1, 2, 3}));
  for (const unsigned int degree : {1, 2, 3})
    {
      std::vector<unsigned int> order = vtk_node_order(degree);
      EXPECT_EQ(order.size(), (degree + 1) * (degree + 2) * (degree + 3) / 6);
      for (unsigned int v = 0; v < 4; ++v)
        EXPECT_EQ(order[v], v);
      std::sort(order.begin(), order.end());
      for (unsigned int i = 0; i < order.size(); ++i)
        EXPECT_EQ(order[i], i);
    }
}

// All observers are called together, as in a run, for all degrees.
TEST(VtkhdfWriter, VtkReadsWhatWasWritten)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      const ScratchFolder scratch;
      ModelBody           body(degree);
      OutputParameters    parameters;
      parameters.probes    = probes;
      const auto observers = observers_of(parameters, scratch.path, body);
      for (unsigned int step = 0; step <= 4; ++step)
        for (const auto &observer : observers)
          body.show(*observer, step, step / 7., step == 4);
      EXPECT_EQ(run_python("check_vtkhdf.py " + scratch.path +
                           " --test-field --moved --degree " +
                           std::to_string(degree) + " --probes '" + probes +
                           "'"),
                0)
        << "degree " << degree;
    }
}

// For the element with bubbles only nodes on vertices and edges are written:
// the mesh consists of quadratic tetrahedra without unused nodes, on any number
// of ranks. The probes are at such nodes, as elsewhere bubbles contribute.
TEST(VtkhdfWriter, BubblesAreLeftOut)
{
  const ScratchFolder scratch;
  ModelBody           body(Element::quadratic_with_bubbles());
  OutputParameters    parameters;
  parameters.probes =
    "corner: 1 0.5 0.25, edge: 0.875 0.5 0.25, diagonal: 0.125 0.125 0";
  const auto observers = observers_of(parameters, scratch.path, body);
  for (unsigned int step = 0; step <= 2; ++step)
    for (const auto &observer : observers)
      body.show(*observer, step, step / 7., step == 2);
  EXPECT_EQ(run_python("check_vtkhdf.py " + scratch.path +
                       " --test-field --degree 2 --probes '" +
                       parameters.probes + "'"),
            0);
}

// The checker notices a wrong field, a wrong degree and a wrong probe.
TEST(VtkhdfWriter, CheckerNoticesErrors)
{
  const ScratchFolder scratch;
  ModelBody           body(2);
  OutputParameters    parameters;
  parameters.probes    = "a: 0.3 0.2 0.1";
  const auto observers = observers_of(parameters, scratch.path, body);
  for (const auto &observer : observers)
    body.show(*observer, 0, 0.3, true);
  const std::string command = "check_vtkhdf.py " + scratch.path;
  EXPECT_EQ(run_python(command + " --probes 'a: 0.3 0.2 0.1'"), 0);
  EXPECT_NE(run_python(command + " --probes 'a: 0.3 0.2 0.1000001' >&-  2>&-"),
            0);
  EXPECT_NE(run_python(command + " --degree 3 >&- 2>&-"), 0);
}

// Results are written at the first step at or after each multiple of 0.25, and
// at the first and the last step: with steps of 0.1 these are 3 (0.3), 5 (0.5)
// and 8 (0.8).
TEST(VtkhdfWriter, TimeBetweenResults)
{
  const ScratchFolder scratch;
  ModelBody           body(1);
  VtkhdfWriter        writer(scratch.path, 0.25);
  for (unsigned int step = 0; step <= 9; ++step)
    body.show(writer, step, 0.1 * step, step == 9);
  EXPECT_EQ(files_in(scratch.path + "/solution"),
            (std::vector<std::string>{"mesh.h5",
                                      "step_000000.h5",
                                      "step_000003.h5",
                                      "step_000005.h5",
                                      "step_000008.h5",
                                      "step_000009.h5"}));
}

// With blocks of three results, 32 results make blocks of 27, 3, 1 and 1 (three
// levels), which VTK reads like the results themselves.
TEST(VtkhdfWriter, BlocksStandForResults)
{
  const ScratchFolder scratch;
  ModelBody           body(2);
  VtkhdfWriter        writer(scratch.path, 0, 3);
  HistoryWriter       history(scratch.path, Probes({}, body.discretization));
  for (unsigned int step = 0; step < 32; ++step)
    {
      body.show(writer, step, step / 64., step == 31);
      body.show(history, step, step / 64., step == 31);
    }
  EXPECT_TRUE(fs::exists(scratch.path + "/solution/block_3_000000.h5"));
  EXPECT_TRUE(fs::exists(scratch.path + "/solution/block_2_000018.h5"));
  EXPECT_TRUE(fs::exists(scratch.path + "/solution/block_000027.h5"));
  EXPECT_EQ(run_python("check_vtkhdf.py " + scratch.path + " --test-field"), 0);
}

// The file that refers to all results is rewritten after each of them, so it
// must not grow with their number: for nine times as many results, which are in
// one block as well, only a name is a few letters longer.
TEST(VtkhdfWriter, IndexDoesNotGrow)
{
  const ScratchFolder scratch;
  ModelBody           body(1);
  VtkhdfWriter        writer(scratch.path, 0, 3);
  HistoryWriter       history(scratch.path, Probes({}, body.discretization));
  std::uintmax_t      sizes[2] = {0, 0};
  for (unsigned int step = 0; step < 729; ++step)
    {
      body.show(writer, step, step / 1024., step == 728);
      body.show(history, step, step / 1024., step == 728);
      wait_for_all();
      if (step == 80 || step == 728)
        sizes[step == 80 ? 0 : 1] =
          fs::file_size(scratch.path + "/solution.vtkhdf");
    }
  EXPECT_LT(sizes[1], sizes[0] + 100);
  EXPECT_EQ(run_python("check_vtkhdf.py " + scratch.path + " --test-field"), 0);
}

// If a file cannot be written, all ranks get the error, and earlier files
// remain. A limited file size simulates a full disk.
TEST(VtkhdfWriter, FullDiskLosesNothing)
{
  const ScratchFolder scratch;
  ModelBody           body(3);
  OutputParameters    parameters;
  const auto          observers = observers_of(parameters, scratch.path, body);
  for (unsigned int step = 0; step <= 2; ++step)
    for (const auto &observer : observers)
      body.show(*observer, step, step / 7., false);
  {
    const FileSizeLimit limit(6000);
    EXPECT_EQ(message_of<MachineError>(
                [&] { body.show(*observers.front(), 3, 3 / 7., true); }),
              scratch.path +
                "/solution/step_000003.h5: the file cannot be written (is the "
                "disk full, or permission missing?)");
  }
  EXPECT_EQ(files_in(scratch.path + "/solution"),
            (std::vector<std::string>{"mesh.h5",
                                      "step_000000.h5",
                                      "step_000001.h5",
                                      "step_000002.h5"}));
  EXPECT_EQ(run_python("check_vtkhdf.py " + scratch.path + " --test-field"), 0);
}

TEST(VtkhdfWriter, MissingFolderIsAnError)
{
  ModelBody    body(1);
  VtkhdfWriter writer("/proc/corotet", 0);
  EXPECT_EQ(message_of<MachineError>([&] { body.show(writer, 0, 0, false); }),
            "/proc/corotet/solution: the folder cannot be made: No such file "
            "or directory");
}

// This is not a test, but a run without end that check_killed.py starts and
// kills. Each rank tells its process id.
TEST(VtkhdfWriter, RunWithoutEnd)
{
  const char *folder = std::getenv("COROTET_TEST_RUN_WITHOUT_END");
  if (folder == nullptr)
    GTEST_SKIP() << "only for check_killed.py";
  std::ofstream(std::string(folder) + "/pid_" + std::to_string(rank()))
    << getpid() << std::endl;
  const std::string directory = std::string(folder) + "/run";
  fs::create_directories(directory);
  wait_for_all();
  ModelBody        body(3);
  OutputParameters parameters;
  parameters.probes    = probes;
  parameters.n_states  = 0;
  const auto observers = observers_of(parameters, directory, body);
  for (unsigned int step = 0; step < 100000; ++step)
    for (const auto &observer : observers)
      body.show(*observer, step, step / 1024., false);
}

// A run that is killed at any moment, on one rank or two, leaves every finished
// result readable.
TEST(VtkhdfWriter, KilledRunIsReadable)
{
  if (n_ranks() > 1)
    GTEST_SKIP() << "starts its own ranks";
  EXPECT_EQ(run_python("check_killed.py " +
                       fs::read_symlink("/proc/self/exe").string()),
            0);
}
