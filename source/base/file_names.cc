// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/file_names.h>

#include <filesystem>
#include <system_error>

namespace corotet
{
  std::string
  file_in(const std::string &folder, const std::string &name)
  {
    namespace fs         = std::filesystem;
    const fs::path  path = fs::path(folder) / name;
    const fs::path  text = path.lexically_normal();
    std::error_code error;
    if (fs::exists(path, error) && !fs::equivalent(path, text, error))
      return path.string();
    return text.string();
  }
} // namespace corotet
