// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace corotet::gmsh_program
{
  namespace
  {
    void
    require(const bool is_right, const std::string &what)
    {
      if (!is_right)
        throw std::runtime_error(what + ": " + std::strerror(errno));
    }



    void
    limit(const int resource, const rlim_t value)
    {
      rlimit limits{};
      getrlimit(resource, &limits);
      limits.rlim_cur = limits.rlim_max = std::min(value, limits.rlim_max);
      require(setrlimit(resource, &limits) == 0, "setrlimit");
    }



    // The size of private writable memory, which RLIMIT_DATA limits [byte].
    std::uint64_t
    data_size()
    {
      std::ifstream status("/proc/self/status");
      for (std::string word; status >> word;)
        if (word == "VmData:")
          {
            std::uint64_t kilobytes = 0;
            status >> kilobytes;
            return kilobytes * 1024;
          }
      return 0;
    }



    void
    restrict_files(const std::vector<std::string> &readable)
    {
      constexpr std::uint64_t read =
        LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
      landlock_ruleset_attr handled{};
      // All rights of Landlock's first version: to execute, write and read
      // files, and to make and remove files of any kind.
      handled.handled_access_fs = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;
      const int rules =
        syscall(SYS_landlock_create_ruleset, &handled, sizeof(handled), 0);
      if (rules < 0 && (errno == ENOSYS || errno == EOPNOTSUPP))
        return;
      require(rules >= 0, "landlock_create_ruleset");
      for (const std::string &path : readable)
        {
          const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
          if (file < 0)
            continue;
          struct stat properties{};
          fstat(file, &properties);
          landlock_path_beneath_attr rule{};
          rule.parent_fd      = file;
          rule.allowed_access = S_ISDIR(properties.st_mode) ?
                                  read :
                                  std::uint64_t(LANDLOCK_ACCESS_FS_READ_FILE);
          require(syscall(SYS_landlock_add_rule,
                          rules,
                          LANDLOCK_RULE_PATH_BENEATH,
                          &rule,
                          0) == 0,
                  "landlock_add_rule");
          close(file);
        }
      require(syscall(SYS_landlock_restrict_self, rules, 0) == 0,
              "landlock_restrict_self");
      close(rules);
    }
  } // namespace



  void
  confine(const std::vector<std::string> &readable,
          const std::uint64_t             max_memory)
  {
    require(prctl(PR_SET_PDEATHSIG, SIGKILL) == 0, "prctl");
    require(prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0, "prctl");
    limit(RLIMIT_DATA, data_size() + max_memory);
    limit(RLIMIT_CORE, 0);
    // Without Landlock files can be created, but this limit keeps them empty.
    limit(RLIMIT_FSIZE, 0);
    std::signal(SIGXFSZ, SIG_IGN);
    restrict_files(readable);
  }
} // namespace corotet::gmsh_program
