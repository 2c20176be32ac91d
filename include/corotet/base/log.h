// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_log_h
#define corotet_base_log_h

#include <mpi.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The program's messages to its user, line by line: on the terminal of rank 0
   * (unless quiet) and in log.txt.
   *
   * Lines that come before the file is opened are kept and written into it
   * then. A progress line goes to a terminal only (not through mpirun), where
   * it stands below the last line and is overwritten by the next; it is never
   * part of the file.
   */
  class Log
  {
  public:
    /// On ranks of @p comm other than 0 nothing is shown or written.
    Log(const MPI_Comm comm, const bool quiet);
    ~Log();

    Log(const Log &) = delete;
    Log &
    operator=(const Log &) = delete;

    void
    line(const std::string &message);

    /// Writes a line to the file only, if the user is told by other means.
    void
    note(const std::string &message);

    /// Writes a line that starts with "warning: ".
    void
    warning(const std::string &text);

    /// Counts an event that is worth a look at the end, such as a "step made in
    /// parts", in the plural "steps made in parts"; warnings are counted, too.
    void
    count(const std::string &one, const std::string &several);

    /// What was counted: "2 warnings, 5 steps made in parts"; empty if nothing.
    std::string
    counts() const;

    /// Replaces the progress line. If the completed share is known, from 0 to
    /// 1, a bar shows it where the terminal has room. Without a terminal, or
    /// when quiet, nothing is shown.
    void
    progress(const std::string &text, const double share = -1);

    /// From now on lines go to @p path too, those shown so far first. Throws
    /// MachineError if it cannot be written. Collective.
    void
    open(const std::string &path);

    /// Like open(), but continues the file after its first @p size bytes and
    /// removes the rest. Of the lines shown so far only warnings are written to
    /// it. Collective.
    void
    resume(const std::string &path, const std::int64_t size);

    /// The size of the file [byte]. Throws MachineError if a line could not be
    /// written. Collective.
    /// Collective.
    std::int64_t
    size();

  private:
    void
    clear_progress();
    /// Writes a line to the file, now or when it is opened.
    void
    write(const std::string &text);

    MPI_Comm                 comm;
    bool                     root;
    bool                     quiet;
    bool                     terminal;
    bool                     progress_shown = false;
    std::vector<std::string> kept;
    std::ofstream            file;
    struct Count
    {
      std::string  one, several;
      unsigned int n;
    };
    /// The counts, in the order of their first events.
    std::vector<Count> counted;
  };
} // namespace corotet

#endif
