// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/whole_file.h>

#include <filesystem>
#include <fstream>
#include <system_error>

namespace corotet
{
  void
  write_whole_file(const std::string &path,
                   const std::string &text,
                   const std::string &what)
  {
    // It gets its name when it is complete.
    const std::string temporary = path + ".tmp";
    std::ofstream     file(temporary);
    file << text;
    file.close();
    std::error_code error;
    if (file)
      std::filesystem::rename(temporary, path, error);
    if (file && !error)
      return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw MachineError(path + ": " + what +
                       " cannot be written (is the disk full, or permission "
                       "missing?)");
  }
} // namespace corotet
