// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/output/directory_lock.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace corotet
{
  namespace
  {
    const std::string signature = "Results of corotet.";

    std::string
    machine_name()
    {
      std::array<char, 200> name{};
      gethostname(name.data(), name.size() - 1);
      return name.data();
    }

    // The owner of the lock, in the second line of the file.
    std::string
    owner_in(const std::string &path)
    {
      std::ifstream file(path);
      std::string   line;
      std::getline(file, line);
      std::getline(file, line);
      return line.empty() ? "another process" : line;
    }
  } // namespace

  const std::string DirectoryLock::file_name = ".corotet";

  bool
  DirectoryLock::has_marked(const std::string &directory)
  {
    std::ifstream file(directory + "/" + file_name);
    std::string   line;
    return std::getline(file, line) && line == signature;
  }

  DirectoryLock::DirectoryLock(const std::string &directory,
                               const MPI_Comm     comm,
                               Log               &log)
  {
    on_root(comm, [&] { take(directory, log); });
  }

  void
  DirectoryLock::take(const std::string &directory, Log &log)
  {
    const std::string path = directory + "/" + file_name;
    std::error_code   error;
    std::filesystem::create_directories(directory, error);
    const auto fail = [&](const int number) {
      const std::string reason = std::generic_category().message(number);
      if (descriptor >= 0)
        close(descriptor);
      descriptor = -1;
      throw MachineError(
        fmt::format("the output directory '{}' cannot be made or emptied: {}",
                    directory,
                    reason));
    };
    descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (descriptor < 0)
      fail(error ? error.value() : errno);
    const bool is_locked = flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!is_locked && errno == EWOULDBLOCK)
      {
        close(descriptor);
        descriptor = -1;
        throw MachineError(
          fmt::format("the output directory '{}' is in use by {}; wait for it, "
                      "or choose another directory",
                      directory,
                      owner_in(path)));
      }
    // Lustre and NFS may be set up without locks.
    if (!is_locked && errno != ENOLCK && errno != ENOSYS && errno != EOPNOTSUPP)
      fail(errno);
    if (!is_locked)
      log.warning(
        fmt::format("the output directory '{}' cannot be locked ({}): "
                    "let no other run write there",
                    directory,
                    std::generic_category().message(errno)));
    const std::string text = fmt::format("{}\nprocess {} on {}\n",
                                         signature,
                                         getpid(),
                                         machine_name());
    // The file is truncated after writing, so its first line, which does not
    // change, stays whatever fails.
    if (pwrite(descriptor, text.data(), text.size(), 0) !=
          static_cast<ssize_t>(text.size()) ||
        ftruncate(descriptor, text.size()) != 0)
      fail(errno);
  }

  DirectoryLock::~DirectoryLock()
  {
    if (descriptor >= 0)
      close(descriptor);
  }
} // namespace corotet
