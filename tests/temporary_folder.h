// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_temporary_folder_h
#define corotet_tests_temporary_folder_h

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

/**
 * A new empty folder, removed with its content at the end. Every object, so
 * every rank too, has its own.
 */
class TemporaryFolder
{
public:
  TemporaryFolder()
    : path(std::filesystem::temp_directory_path() / "corotet-test-XXXXXX")
  {
    std::string name = path.string();
    if (mkdtemp(name.data()) == nullptr)
      throw std::runtime_error("no temporary folder can be made");
    path = name;
  }

  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(path, ignored);
  }

  TemporaryFolder(const TemporaryFolder &) = delete;
  TemporaryFolder &
  operator=(const TemporaryFolder &) = delete;

  /// The path of the file @p name in the folder.
  std::string
  operator/(const std::string &name) const
  {
    return (path / name).string();
  }

  /// Writes a file and gives its path.
  std::string
  write(const std::string &name, const std::string &content) const
  {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name) << content;
    return *this / name;
  }

  /// The content of a file.
  std::string
  read(const std::string &name) const
  {
    std::ifstream file(path / name);
    return {std::istreambuf_iterator<char>(file),
            std::istreambuf_iterator<char>()};
  }

private:
  std::filesystem::path path;
};

#endif
