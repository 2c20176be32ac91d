// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <iostream>

namespace corotet
{
  Log::Log(const MPI_Comm comm, const bool quiet)
    : root(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , quiet(quiet)
    , terminal(root && !quiet && isatty(STDOUT_FILENO) != 0)
  {}

  Log::~Log()
  {
    clear_progress();
  }

  void
  Log::line(const std::string &text)
  {
    if (!root)
      return;
    clear_progress();
    if (!quiet)
      std::cout << text << std::endl;
    if (file.is_open())
      file << text << std::endl;
    else
      kept += text + '\n';
  }

  void
  Log::warning(const std::string &text)
  {
    line("warning: " + text);
  }

  void
  Log::progress(const std::string &text)
  {
    if (!terminal)
      return;
    std::cout << "\r\033[K" << text << std::flush;
    progress_shown = true;
  }

  void
  Log::open(const std::string &path)
  {
    if (!root)
      return;
    file.open(path);
    if (!file)
      throw MachineError(path + ": the log file cannot be written");
    file << kept << std::flush;
    kept.clear();
  }

  void
  Log::clear_progress()
  {
    if (progress_shown)
      std::cout << "\r\033[K" << std::flush;
    progress_shown = false;
  }
} // namespace corotet
