// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/log.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iostream>

namespace corotet
{
  namespace
  {
    // mpirun gives its processes a terminal of its own, whatever its own output
    // goes to: a process cannot tell whether a person sees its output.
    bool
    started_by_mpirun()
    {
      return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr ||
             std::getenv("PMI_SIZE") != nullptr;
    }

    // The number of columns of the terminal: a line that wraps could not be
    // overwritten.
    std::size_t
    terminal_width()
    {
      winsize size{};
      if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        return size.ws_col;
      return 80;
    }

    // A progress bar such as "[====    ]".
    std::string
    bar(const double share, const std::size_t width)
    {
      const auto n_done =
        static_cast<std::size_t>(std::clamp(share, 0., 1.) * width);
      return '[' + std::string(n_done, '=') + std::string(width - n_done, ' ') +
             ']';
    }
  } // namespace

  Log::Log(const MPI_Comm comm, const bool quiet)
    : comm(comm)
    , root(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , quiet(quiet)
    , terminal(root && !quiet && isatty(STDOUT_FILENO) != 0 &&
               !started_by_mpirun())
  {}

  Log::~Log()
  {
    clear_progress();
  }

  void
  Log::line(const std::string &message)
  {
    if (!root)
      return;
    // Names in the user's files may have control characters.
    const std::string text = printable(message, /* keep_lines = */ true);
    clear_progress();
    if (!quiet)
      std::cout << text << std::endl;
    write(text);
  }

  void
  Log::note(const std::string &message)
  {
    if (root)
      write(printable(message, /* keep_lines = */ true));
  }

  void
  Log::write(const std::string &text)
  {
    if (file.is_open())
      file << text << std::endl;
    else
      kept.push_back(text);
  }

  void
  Log::warning(const std::string &text)
  {
    line("warning: " + text);
    count("warning", "warnings");
  }

  void
  Log::count(const std::string &one, const std::string &several)
  {
    const auto known =
      std::find_if(counted.begin(), counted.end(), [&](const Count &count) {
        return count.one == one;
      });
    if (known == counted.end())
      counted.push_back({one, several, 1});
    else
      ++known->n;
  }

  std::string
  Log::counts() const
  {
    std::string text;
    for (const auto &[one, several, n] : counted)
      text += fmt::format("{}{} {}",
                          text.empty() ? "" : ", ",
                          n,
                          n == 1 ? one : several);
    return text;
  }

  void
  Log::progress(const std::string &text, const double share)
  {
    if (!terminal)
      return;
    const std::size_t width = terminal_width() - 1;
    std::string       shown = text.substr(0, width);
    // Lengths of the bar without its brackets and the blank before it.
    constexpr std::size_t shortest_bar = 8, longest_bar = 30;
    const std::size_t     left = width - shown.size();
    if (share >= 0 && left >= shortest_bar + 3)
      shown += ' ' + bar(share, std::min(longest_bar, left - 3));
    std::cout << "\r\033[K" << shown << std::flush;
    progress_shown = true;
  }

  void
  Log::open(const std::string &path)
  {
    on_root(comm, [&] {
      file.open(path);
      for (const std::string &text : kept)
        file << text << '\n';
      file << std::flush;
      if (!file)
        {
          // An empty log file must not remain: a new run would refuse to
          // overwrite it.
          if (std::filesystem::is_regular_file(path))
            std::filesystem::remove(path);
          throw MachineError(path + ": the log file cannot be written (is the "
                                    "disk full, or permission missing?)");
        }
      kept.clear();
    });
  }

  void
  Log::resume(const std::string &path, const std::int64_t size)
  {
    on_root(comm, [&] {
      continue_file(path, size, "the log file", file);
      // Only warnings are written; the other lines repeat those of the first
      // start.
      for (const std::string &text : kept)
        if (text.starts_with("warning: "))
          file << text << std::endl;
      kept.clear();
    });
  }

  std::int64_t
  Log::size()
  {
    return from_root(comm, [&] {
      const std::int64_t size =
        file.is_open() ? file.tellp() : std::streampos(0);
      if (size < 0)
        throw MachineError(
          "the log file cannot be written (is the disk full?)");
      return size;
    });
  }

  void
  Log::clear_progress()
  {
    if (progress_shown)
      std::cout << "\r\033[K" << std::flush;
    progress_shown = false;
  }
} // namespace corotet
