// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_scratch_folder_h
#define corotet_source_mesh_scratch_folder_h

#include <corotet/base/exceptions.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

namespace corotet
{
  /// A folder for files that are passed to another program, which exists as
  /// long as this object. Throws MachineError if it cannot be made.
  class ScratchFolder
  {
  public:
    ScratchFolder()
    {
      std::string name =
        (std::filesystem::temp_directory_path() / "corotet-XXXXXX").string();
      if (mkdtemp(name.data()) == nullptr)
        throw MachineError(name + ": cannot be made: " + std::strerror(errno));
      folder = name;
    }

    ScratchFolder(const ScratchFolder &) = delete;
    ScratchFolder &
    operator=(const ScratchFolder &) = delete;

    ~ScratchFolder()
    {
      std::error_code error;
      std::filesystem::remove_all(folder, error);
    }

    std::string
    path(const std::string &name) const
    {
      return (folder / name).string();
    }

  private:
    std::filesystem::path folder;
  };
} // namespace corotet

#endif
