// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_whole_file_h
#define corotet_base_whole_file_h

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <fstream>
#include <istream>
#include <string>

namespace corotet
{
  /// Writes a file so that it is complete or absent. Throws MachineError: @p
  /// what ("the summary") cannot be written. @p durable: the file also survives
  /// a loss of power.
  void
  write_whole_file(const std::string &path,
                   const std::string &text,
                   const std::string &what,
                   const bool         durable = false);

  /// The same of @p values, indented; bytes of names that are no UTF-8 are
  /// replaced.
  void
  write_json_file(const std::string            &path,
                  const nlohmann::ordered_json &values,
                  const std::string            &what);

  /// The content of a file. Throws MachineError if the file cannot be read to
  /// its end.
  std::string
  read_whole_file(const std::string &path);

  /// The rest of the file @p path. Throws MachineError if it cannot be read to
  /// its end.
  std::string
  read_to_end(std::istream &file, const std::string &path);

  /// Throws MachineError if reading of the file @p path stopped because of a
  /// failure and not at its end.
  void
  check_read_to_end(const std::istream &file, const std::string &path);

  /// Opens @p file at @p path to continue after its first @p size bytes, which
  /// must exist; the rest is removed. Throws MachineError.
  void
  continue_file(const std::string &path,
                const std::int64_t size,
                const std::string &what,
                std::ofstream     &file);

  /// Waits until a file, or the names in a folder, are on the disk. Returns
  /// whether that succeeded.
  bool
  sync_to_disk(const std::string &path);

  /// Waits until all that has been written to the file system of a folder is on
  /// the disk. Throws MachineError.
  void
  sync_file_system(const std::string &folder);
} // namespace corotet

#endif
