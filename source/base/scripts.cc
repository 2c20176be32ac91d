// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/scripts.h>

#include <dlfcn.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

namespace corotet
{
  namespace
  {
    // The file that holds this code: the program, or the shared library.
    std::filesystem::path
    file_of_this_code()
    {
      Dl_info info;
      if (dladdr(reinterpret_cast<const void *>(&find_script), &info) == 0 ||
          info.dli_fname == nullptr)
        return {};
      return info.dli_fname;
    }
  } // namespace

  std::string
  find_script(const std::string &name)
  {
    for (const std::filesystem::path &file :
         {std::filesystem::path("/proc/self/exe"), file_of_this_code()})
      {
        std::error_code             error;
        const std::filesystem::path real =
          std::filesystem::canonical(file, error);
        if (error)
          continue;
        for (std::filesystem::path folder = real.parent_path();;
             folder                       = folder.parent_path())
          {
            const std::filesystem::path script =
              folder / "share" / "corotet" / "scripts" / name;
            if (std::filesystem::exists(script, error))
              return script;
            if (folder == folder.parent_path())
              break;
          }
      }
    return "";
  }

  std::optional<int>
  run_and_wait(const std::string              &path,
               const std::vector<std::string> &arguments)
  {
    std::vector<std::string> words = {path};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char *> pointers;
    for (std::string &word : words)
      pointers.push_back(word.data());
    pointers.push_back(nullptr);

    pid_t process;
    if (posix_spawn(
          &process, path.c_str(), nullptr, nullptr, pointers.data(), environ) !=
        0)
      return {};
    int   status;
    pid_t ended;
    do
      ended = waitpid(process, &status, 0);
    while (ended < 0 && errno == EINTR);
    if (ended != process || !WIFEXITED(status))
      return {};
    return WEXITSTATUS(status);
  }
} // namespace corotet
