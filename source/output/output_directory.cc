// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/output/directory_lock.h>
#include <corotet/output/output_directory.h>

#include <linux/magic.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <regex>
#include <string_view>
#include <system_error>
#include <vector>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string directory_entry = "Output/Directory";

    // The names of a run's results, as regular expressions for paths relative
    // to the output directory. Folders are removed if they become empty.
    const std::array<std::string_view, 6> own_files{
      {R"(study(_[A-Za-z0-9_]+)?\.(csv|tex|svg|png)(\.tmp)?)",
       R"(rows/[^/]+\.(json|log)(\.tmp)?)",
       R"(((solution|stress_points|obstacles)\.vtkhdf|history\.csv|modes\.csv|verification\.csv|summary\.json|parameters\.prm|log\.txt)(\.tmp)?)",
       R"((solution|stress_points|obstacles)/(mesh|step_[0-9]+|block_[0-9_]+)\.h5(\.tmp)?)",
       R"((rows/[^/]+/)?checkpoint/step_[0-9]+(_[0-9]+)?\.(h5|json)(\.tmp)?)",
       // The page of a run, and its temporary files while scripts/report writes
       // it.
       R"(report\.html|\.report\.html\..*)"}};
    const std::array<std::string_view, 5> own_folders{
      {"solution",
       "stress_points",
       "obstacles",
       "rows(/[^/]+)?",
       "(rows/[^/]+/)?checkpoint"}};

    template <typename Patterns>
    bool
    matches(const std::string &name, const Patterns &patterns)
    {
      return std::any_of(
        patterns.begin(), patterns.end(), [&](const std::string_view pattern) {
          return std::regex_match(name, std::regex(std::string(pattern)));
        });
    }

    bool
    is_own(const fs::path &relative_path, const fs::file_status status)
    {
      return (fs::is_regular_file(status) &&
              matches(relative_path.generic_string(), own_files)) ||
             (fs::is_directory(status) &&
              matches(relative_path.generic_string(), own_folders));
    }

    // Whether a file is the mark of the directory, which is kept.
    bool
    is_mark(const fs::path &relative_path)
    {
      return relative_path == DirectoryLock::file_name;
    }

    bool
    has_no_files(const fs::path &directory)
    {
      return std::all_of(fs::directory_iterator(directory),
                         fs::directory_iterator(),
                         [](const fs::directory_entry &entry) {
                           return is_mark(entry.path().filename());
                         });
    }

    void
    check_mark(const fs::path &directory)
    {
      if (!DirectoryLock::has_marked(directory.string()))
        throw InputError(directory_entry,
                         "the output directory '" + directory.string() +
                           "' is not empty and holds no results of corotet; "
                           "only a directory of results can be overwritten");
    }

    // All results below the directory, folders after their contents. Throws if
    // there is anything else.
    std::vector<fs::path>
    old_results(const fs::path &directory)
    {
      check_mark(directory);
      std::vector<fs::path> results;
      for (const fs::directory_entry &entry :
           fs::recursive_directory_iterator(directory))
        {
          const fs::path path = entry.path().lexically_relative(directory);
          const fs::file_status status = entry.symlink_status();
          // Another run may be writing there; then its lock is found later.
          if (is_mark(path) || !fs::exists(status))
            continue;
          if (!is_own(path, status))
            throw InputError(directory_entry,
                             "the output directory '" + directory.string() +
                               "' holds '" + path.string() +
                               "', which is no result of corotet; only a "
                               "directory of results can be overwritten");
          results.push_back(entry.path());
        }
      std::reverse(results.begin(), results.end());
      return results;
    }

    // The paths to remove from the directory before a run, folders after their
    // contents. Throws if they must not be removed.
    std::vector<fs::path>
    to_be_removed(const fs::path &directory, const bool overwrite)
    {
      if (fs::is_symlink(directory) && !fs::exists(directory))
        throw InputError(directory_entry,
                         "the output directory '" + directory.string() +
                           "' is a link to '" +
                           fs::read_symlink(directory).string() +
                           "', which does not exist; make it, or choose "
                           "another name");
      if (fs::exists(directory) && !fs::is_directory(directory))
        throw InputError(directory_entry,
                         "the output directory '" + directory.string() +
                           "' is a file; a directory or a new name is allowed");
      if (!fs::exists(directory) || has_no_files(directory))
        return {};
      if (!overwrite)
        throw InputError(directory_entry,
                         "the output directory '" + directory.string() +
                           "' is not empty; choose another one" +
                           (fs::exists(directory / ".corotet") ?
                              ", or set Output/Overwrite = true to remove the "
                              "results in it" :
                              ""));
      return old_results(directory);
    }

    // Throws if the directory cannot be made or filled below the innermost
    // existing part of its path.
    void
    check_place(const fs::path &directory)
    {
      const fs::path place = existing_place(directory);
      if (!fs::is_directory(place))
        throw InputError(directory_entry,
                         "the output directory '" +
                           shortened(directory.string()) + "' is below '" +
                           shortened(place.string()) +
                           "', which is a file; allowed is a name in a folder");
      struct statfs properties{};
      int           number = 0;
      if (statfs(place.c_str(), &properties) != 0 ||
          access(place.c_str(), W_OK | X_OK) != 0)
        number = errno;
      else if (properties.f_type == PROC_SUPER_MAGIC ||
               properties.f_type == SYSFS_MAGIC)
        number = EROFS;
      if (number != 0)
        throw MachineError(
          "the output directory '" + shortened(directory.string()) +
          "' cannot be made or filled in '" + shortened(place.string()) +
          "': " + std::generic_category().message(number));
    }

    // Runs @p action with the path of the directory on rank 0.
    void
    on_root_with_directory(const std::string &directory,
                           const MPI_Comm     comm,
                           const std::function<void(const fs::path &)> &action)
    {
      on_root(comm, [&] {
        try
          {
            const fs::path path = directory;
            // The meaning of '..' depends on links before it.
            const bool goes_up =
              std::find(path.begin(), path.end(), "..") != path.end();
            action(goes_up ? fs::weakly_canonical(path) :
                             path.lexically_normal());
          }
        catch (const fs::filesystem_error &error)
          {
            const std::string message =
              "the output directory '" + shortened(directory) +
              "' cannot be made or emptied: " + error.code().message();
            if (error.code() == std::errc::filename_too_long ||
                error.code() == std::errc::not_a_directory ||
                error.code() == std::errc::too_many_symbolic_link_levels)
              throw InputError(directory_entry, message);
            throw MachineError(message);
          }
      });
    }
  } // namespace

  void
  check_output_directory(const std::string &directory,
                         const bool         overwrite,
                         const MPI_Comm     comm)
  {
    on_root_with_directory(directory, comm, [&](const fs::path &path) {
      to_be_removed(path, overwrite);
      check_place(path);
    });
  }

  bool
  is_filled(const std::string &directory, const MPI_Comm comm)
  {
    bool result = false;
    on_root_with_directory(directory, comm, [&](const fs::path &path) {
      result = fs::exists(path) && !has_no_files(path);
    });
    return from_root(comm, [&] { return result; });
  }

  void
  check_directory_of_restart(const std::string &directory, const MPI_Comm comm)
  {
    on_root_with_directory(directory, comm, [](const fs::path &path) {
      check_place(path);
      if (fs::exists(path) && !has_no_files(path))
        check_mark(path);
    });
  }

  void
  prepare_output_directory(const std::string &directory,
                           const bool         overwrite,
                           const MPI_Comm     comm)
  {
    on_root_with_directory(directory, comm, [&](const fs::path &path) {
      const std::vector<fs::path> old = to_be_removed(path, overwrite);
      fs::create_directories(path);
      for (const fs::path &file : old)
        fs::remove(file);
    });
  }

  fs::path
  existing_place(const fs::path &directory)
  {
    fs::path place = fs::absolute(directory);
    while (!fs::exists(place) && place.has_relative_path())
      place = place.parent_path();
    return place;
  }
} // namespace corotet
