// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_measure_h
#define corotet_benchmarks_measure_h

#include <deal.II/base/mpi.h>

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <string>

namespace corotet::benchmarks
{
  /// Initializes MPI, and finalizes it at its destruction. MPI gets only the
  /// program's name: other arguments would go to PETSc, which warns of unknown
  /// ones.
  class Session
  {
  public:
    explicit Session(char **argv)
      : program{argv[0], nullptr}
      , mpi(n_arguments, arguments, 1)
    {}

  private:
    int n_arguments = 1;
    // A default could not have the constructor's argument.
    // NOLINTNEXTLINE(modernize-use-default-member-init)
    char                                    *program[2];
    char                                   **arguments = program;
    dealii::Utilities::MPI::MPI_InitFinalize mpi;
  };

  /// Figures that are reported with the time, by their names.
  using Counters = std::map<std::string, double>;

  /// The wall time [s] that @p action takes on the slowest rank. Collective.
  double
  seconds(const std::function<void()> &action);

  /**
   * Registers a benchmark of something short: @p prepare makes the action that
   * is timed, and the figures that go with it. The action is called until
   * @p duration [s] are over in each of @p repetitions.
   */
  struct Measured
  {
    std::function<void()> action;
    Counters              counters;
    std::function<void()> between = nullptr;
  };

  void
  add_short(const std::string               &name,
            const std::function<Measured()> &prepare,
            const unsigned int               repetitions = 7,
            const double                     duration    = 0.1);

  /**
   * Registers a benchmark of an action as a Krylov method sees it: before every
   * call @p between() is called, which is not timed and uses the vectors as
   * such a method does. The time of a repetition is the median over its calls.
   * An exception of @p prepare, which all ranks must throw, is reported
   * instead.
   */
  void
  add_interleaved(const std::string               &name,
                  const std::function<Measured()> &prepare,
                  const unsigned int               repetitions = 3,
                  const double                     duration    = 0.3);

  /// Registers a benchmark of something long, which runs @p repetitions times.
  /// It returns its figures; "seconds" is the reported time. An exception,
  /// which all ranks must throw, is reported instead.
  void
  add_long(const std::string               &name,
           const std::function<Counters()> &action,
           const unsigned int               repetitions = 1);

  /// Runs the registered benchmarks that Google Benchmark's arguments select.
  /// Rank 0 shows and writes the results. Collective.
  int
  run(int argc, char **argv);

  /// The largest resident memory of this process so far [bytes]; not that of
  /// the program that started it.
  double
  peak_memory();

  /// The resident memory of this process [bytes].
  double
  present_memory();
} // namespace corotet::benchmarks

#endif
