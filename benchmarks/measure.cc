// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "measure.h"

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <vector>

namespace corotet::benchmarks
{
  namespace
  {
    /// A reporter that shows nothing, for ranks other than 0.
    class Silence : public benchmark::BenchmarkReporter
    {
    public:
      bool
      ReportContext(const Context &) override
      {
        return true;
      }

      void
      ReportRuns(const std::vector<Run> &) override
      {}
    };

    void
    report(benchmark::State &state, const Counters &counters)
    {
      for (const auto &[name, value] : counters)
        state.counters[name] = value;
    }
  } // namespace

  namespace
  {
    // Registers repetitions of one iteration each, which @p measure times
    // itself.
    template <typename Measure>
    void
    add(const std::string        &name,
        const Measure            &measure,
        const unsigned int        repetitions,
        const benchmark::TimeUnit unit)
    {
      benchmark::RegisterBenchmark(name, measure)
        ->Iterations(1)
        ->Repetitions(repetitions)
        ->UseManualTime()
        ->Unit(unit);
    }
  } // namespace

  double
  seconds(const std::function<void()> &action)
  {
    MPI_Barrier(MPI_COMM_WORLD);
    const auto start = std::chrono::steady_clock::now();
    action();
    return dealii::Utilities::MPI::max(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start)
        .count(),
      MPI_COMM_WORLD);
  }

  void
  add_short(const std::string               &name,
            const std::function<Measured()> &prepare,
            const unsigned int               repetitions,
            const double                     duration)
  {
    add(
      name,
      [=](benchmark::State &state) {
        const Measured measured = prepare();
        // This call also warms the caches; its time is the same on all ranks.
        const double once = seconds(measured.action);
        const int n = std::clamp(static_cast<int>(duration / once), 1, 1000000);
        for (auto _ : state)
          state.SetIterationTime(seconds([&] {
                                   for (int i = 0; i < n; ++i)
                                     measured.action();
                                 }) /
                                 n);
        report(state, measured.counters);
      },
      repetitions,
      benchmark::kMicrosecond);
  }

  void
  add_interleaved(const std::string               &name,
                  const std::function<Measured()> &prepare,
                  const unsigned int               repetitions,
                  const double                     duration)
  {
    add(
      name,
      [=](benchmark::State &state) {
        Measured measured;
        try
          {
            measured = prepare();
          }
        catch (const std::exception &error)
          {
            state.SkipWithError(error.what());
            return;
          }
        const double once = seconds(measured.action);
        const int    n = std::clamp(static_cast<int>(duration / once), 5, 1000);
        for (auto _ : state)
          {
            std::vector<double> times(n);
            for (double &time : times)
              {
                measured.between();
                time = seconds(measured.action);
              }
            std::nth_element(times.begin(), times.begin() + n / 2, times.end());
            state.SetIterationTime(times[n / 2]);
          }
        report(state, measured.counters);
      },
      repetitions,
      benchmark::kMicrosecond);
  }

  void
  add_long(const std::string               &name,
           const std::function<Counters()> &action,
           const unsigned int               repetitions)
  {
    const auto measure = [=](benchmark::State &state) {
      for (auto _ : state)
        try
          {
            const Counters counters = action();
            state.SetIterationTime(counters.at("seconds"));
            report(state, counters);
          }
        catch (const std::exception &error)
          {
            state.SkipWithError(error.what());
            return;
          }
    };
    add(name, measure, repetitions, benchmark::kSecond);
  }

  int
  run(int argc, char **argv)
  {
    const bool root =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    std::vector<char *> arguments;
    for (int i = 0; i < argc; ++i)
      if (root || !std::string(argv[i]).starts_with("--benchmark_out"))
        arguments.push_back(argv[i]);
    int n = arguments.size();
    benchmark::Initialize(&n, arguments.data());
    Silence silence;
    if (root)
      benchmark::RunSpecifiedBenchmarks();
    else
      benchmark::RunSpecifiedBenchmarks(&silence);
    benchmark::Shutdown();
    return 0;
  }

  double
  peak_memory()
  {
    std::ifstream status("/proc/self/status");
    std::string   word;
    double        kilobytes = 0;
    while (status >> word)
      if (word == "VmHWM:")
        status >> kilobytes;
    return 1024 * kilobytes;
  }

  double
  present_memory()
  {
    std::ifstream statm("/proc/self/statm");
    double        total = 0, resident = 0;
    statm >> total >> resident;
    return resident * sysconf(_SC_PAGESIZE);
  }
} // namespace corotet::benchmarks
