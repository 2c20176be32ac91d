// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/whole_file.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

namespace corotet
{
  void
  write_whole_file(const std::string &path,
                   const std::string &text,
                   const std::string &what,
                   const bool         durable)
  {
    // The file is written under a temporary name and renamed when it is
    // complete.
    const std::string temporary = path + ".tmp";
    std::ofstream     file(temporary);
    file << text;
    file.close();
    const bool      is_written = file && (!durable || sync_to_disk(temporary));
    std::error_code error;
    if (is_written)
      std::filesystem::rename(temporary, path, error);
    const std::string folder =
      std::filesystem::path(path).parent_path().string();
    if (is_written && !error && (!durable || sync_to_disk(folder)))
      return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw MachineError(path + ": " + what +
                       " cannot be written (is the disk full, or permission "
                       "missing?)");
  }

  void
  write_json_file(const std::string            &path,
                  const nlohmann::ordered_json &values,
                  const std::string            &what)
  {
    write_whole_file(
      path,
      values.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) +
        "\n",
      what);
  }

  std::string
  read_whole_file(const std::string &path)
  {
    std::ifstream file(path, std::ios::binary);
    if (!file)
      throw MachineError(path + ": cannot be read (permission?)");
    return read_to_end(file, path);
  }

  std::string
  read_to_end(std::istream &file, const std::string &path)
  {
    std::string            text;
    std::array<char, 8192> part;
    while (file.read(part.data(), part.size()) || file.gcount() > 0)
      text.append(part.data(), file.gcount());
    check_read_to_end(file, path);
    return text;
  }

  void
  check_read_to_end(const std::istream &file, const std::string &path)
  {
    if (file.bad())
      throw MachineError(path + ": cannot be read to its end");
  }

  void
  continue_file(const std::string &path,
                const std::int64_t size,
                const std::string &what,
                std::ofstream     &file)
  {
    std::error_code error;
    const auto      found = std::filesystem::file_size(path, error);
    if (error || found < static_cast<std::uintmax_t>(size))
      throw MachineError(
        fmt::format("{}: {} cannot be continued: found {}, "
                    "needed are its first {} bytes",
                    path,
                    what,
                    error ? error.message() : fmt::format("{} bytes", found),
                    size));
    std::filesystem::resize_file(path, size, error);
    if (!error)
      file.open(path, std::ios::app);
    if (error || !file)
      throw MachineError(path + ": " + what +
                         " cannot be written (is permission missing?)");
  }

  bool
  sync_to_disk(const std::string &path)
  {
    const int descriptor =
      open(path.empty() ? "." : path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
      return false;
    const bool is_synced = fsync(descriptor) == 0;
    close(descriptor);
    return is_synced;
  }

  void
  sync_file_system(const std::string &folder)
  {
    const int descriptor =
      open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool is_synced = descriptor >= 0 && syncfs(descriptor) == 0;
    const int  number    = errno;
    if (descriptor >= 0)
      close(descriptor);
    if (!is_synced)
      throw MachineError(folder +
                         ": what was written cannot be brought to the "
                         "disk: " +
                         std::generic_category().message(number));
  }
} // namespace corotet
