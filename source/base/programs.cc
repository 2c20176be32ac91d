// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/programs.h>

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>

namespace corotet
{
  namespace
  {
    // The file that holds this code: the program, or the shared library.
    std::filesystem::path
    file_of_this_code()
    {
      Dl_info info;
      if (dladdr(reinterpret_cast<const void *>(&find_installed), &info) == 0 ||
          info.dli_fname == nullptr)
        return {};
      return info.dli_fname;
    }

    // The program corotet that a shell would start.
    std::filesystem::path
    program_of_path()
    {
      const char        *path = std::getenv("PATH");
      std::istringstream folders(path == nullptr ? "" : path);
      std::error_code    error;
      for (std::string folder; std::getline(folders, folder, ':');)
        if (!folder.empty() &&
            std::filesystem::is_regular_file(folder + "/corotet", error))
          return folder + "/corotet";
      return {};
    }

    std::vector<char *>
    pointers_to(std::vector<std::string> &words)
    {
      std::vector<char *> pointers;
      for (std::string &word : words)
        pointers.push_back(word.data());
      pointers.push_back(nullptr);
      return pointers;
    }

    // A descriptor that is closed with its scope.
    struct Descriptor
    {
      explicit Descriptor(const int number = -1)
        : number(number)
      {}

      Descriptor(const Descriptor &) = delete;
      Descriptor &
      operator=(const Descriptor &) = delete;

      ~Descriptor()
      {
        if (number >= 0)
          close(number);
      }

      int number;
    };

    // The environment of a started program: without the variables that make a
    // process a rank of this run, as a program that uses MPI itself would wait
    // for the other ranks. Its memory uses huge pages, as this program's does.
    std::vector<std::string>
    environment_of_others()
    {
      std::vector<std::string> variables;
      if (std::getenv("GLIBC_TUNABLES") == nullptr)
        variables.emplace_back("GLIBC_TUNABLES=glibc.malloc.hugetlb=1");
      for (char **variable = environ; *variable != nullptr; ++variable)
        {
          const std::string text = *variable;
          if (!text.starts_with("OMPI_") && !text.starts_with("PMIX_") &&
              !text.starts_with("PMI_") && !text.starts_with("PRTE_"))
            variables.push_back(text);
        }
      return variables;
    }

    // Starts @p path with its standard output in the pipe.
    pid_t
    start(const std::string        &path,
          std::vector<std::string> &words,
          const int                 pipe_end)
    {
      posix_spawn_file_actions_t actions;
      posix_spawn_file_actions_init(&actions);
      posix_spawn_file_actions_addopen(
        &actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_adddup2(&actions, pipe_end, STDOUT_FILENO);
      posix_spawn_file_actions_addopen(
        &actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
      // The started program does not inherit open files and their locks.
      posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
      // The started program does not inherit blocked or ignored signals.
      posix_spawnattr_t attributes;
      posix_spawnattr_init(&attributes);
      sigset_t none, all;
      sigemptyset(&none);
      sigfillset(&all);
      posix_spawnattr_setsigmask(&attributes, &none);
      posix_spawnattr_setsigdefault(&attributes, &all);
      posix_spawnattr_setflags(&attributes,
                               POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
      std::vector<std::string> variables = environment_of_others();
      pid_t                    process   = 0;
      const int                failure   = posix_spawn(&process,
                                      path.c_str(),
                                      &actions,
                                      &attributes,
                                      pointers_to(words).data(),
                                      pointers_to(variables).data());
      posix_spawnattr_destroy(&attributes);
      posix_spawn_file_actions_destroy(&actions);
      if (failure != 0)
        throw MachineError(path +
                           ": cannot be started: " + std::strerror(failure));
      return process;
    }

    // A program that runs; with this object it is ended.
    class Process
    {
    public:
      explicit Process(const pid_t number)
        : number(number)
      {}

      Process(const Process &) = delete;
      Process &
      operator=(const Process &) = delete;

      ~Process()
      {
        if (number > 0)
          wait_after_kill();
      }

      int
      wait_after_kill()
      {
        kill(number, SIGKILL);
        int status = 0;
        while (waitpid(number, &status, 0) < 0 && errno == EINTR)
          ;
        number = 0;
        return status;
      }

      // What waitpid() says of its end; nothing if it still runs.
      std::optional<int>
      status_of_end()
      {
        int status = 0;
        if (waitpid(number, &status, WNOHANG) == 0)
          return {};
        number = 0;
        return status;
      }

    private:
      pid_t number;
    };
  } // namespace

  std::string
  find_installed(const std::string &name)
  {
    for (const std::filesystem::path &file :
         {std::filesystem::path("/proc/self/exe"),
          file_of_this_code(),
          program_of_path()})
      {
        std::error_code             error;
        const std::filesystem::path real =
          std::filesystem::canonical(file, error);
        if (error)
          continue;
        for (std::filesystem::path folder = real.parent_path();;
             folder                       = folder.parent_path())
          {
            const std::filesystem::path found = folder / name;
            if (std::filesystem::exists(found, error))
              return found;
            if (folder == folder.parent_path())
              break;
          }
      }
    return "";
  }

  ProgramEnd
  run_for_output(const std::string              &path,
                 const std::vector<std::string> &arguments,
                 const double                    time_limit)
  {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw MachineError(path + ": cannot be started: " + std::strerror(errno));
    const Descriptor         from(ends[0]);
    Descriptor               to(ends[1]);
    std::vector<std::string> words = {path};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Process process(start(path, words, to.number));
    close(to.number);
    to.number = -1;

    using Clock             = std::chrono::steady_clock;
    const auto        begin = Clock::now();
    ProgramEnd        end;
    std::vector<char> buffer(1 << 16);
    // The output may end before the program does.
    bool               has_output = true;
    std::optional<int> status;
    while (!status)
      {
        const double left =
          time_limit -
          std::chrono::duration<double>(Clock::now() - begin).count();
        if (left <= 0)
          {
            end.has_exceeded = true;
            status           = process.wait_after_kill();
            break;
          }
        if (!has_output)
          {
            status = process.status_of_end();
            if (!status)
              poll(nullptr, 0, 1);
            continue;
          }
        pollfd    event{from.number, POLLIN, 0};
        const int milliseconds = std::ceil(std::min(left, 1e3) * 1e3);
        const int n_ready      = poll(&event, 1, milliseconds);
        if (n_ready == 0 || (n_ready < 0 && errno == EINTR))
          continue;
        const ssize_t n =
          n_ready > 0 ? read(from.number, buffer.data(), buffer.size()) : -1;
        if (n > 0)
          end.output.append(buffer.data(), n);
        else
          has_output = n < 0 && errno == EINTR;
      }
    if (WIFSIGNALED(*status))
      end.signal = WTERMSIG(*status);
    else
      end.status = WEXITSTATUS(*status);
    return end;
  }

  bool
  run_installed_script(const std::string &name, const std::string &folder)
  {
    const std::string script = find_installed("share/corotet/scripts/" + name);
    if (script.empty())
      return false;
    constexpr double hour = 3600;
    try
      {
        const ProgramEnd end =
          run_for_output(script, {as_argument(folder)}, hour);
        return end.status == 0 && end.signal == 0 && !end.has_exceeded;
      }
    catch (const MachineError &)
      {
        return false;
      }
  }

  std::string
  as_argument(const std::string &path)
  {
    return (path.starts_with('-') ? "./" : "") + path;
  }
} // namespace corotet
