// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_fuzz_targets_h
#define corotet_tests_fuzz_targets_h

#include <corotet/base/exceptions.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>

#include "temporary_folder.h"

/**
 * The readers of files from outside, as functions of arbitrary bytes. Each may
 * refuse its input by throwing an error for users; anything else that goes
 * wrong (a crash, another exception, a broken promise, too much memory or time)
 * is a finding.
 */
namespace fuzz
{
  using Target = void (*)(const std::string &input);

  /// All targets, by their names.
  const std::map<std::string, Target> &
  targets();

  /// Starts what the targets need: MPI, for this process alone.
  void
  initialize();

  void
  read_abaqus_input(const std::string &input);
  void
  read_checkpoint(const std::string &input);
  void
  read_expression(const std::string &input);
  void
  read_geometry(const std::string &input);
  void
  read_gmsh_model(const std::string &input);
  void
  read_hdf5_file(const std::string &input);
  void
  read_list(const std::string &input);
  void
  read_medit_file(const std::string &input);
  void
  read_mesh_file(const std::string &input);
  void
  read_nastran_file(const std::string &input);
  void
  read_parameters(const std::string &input);
  void
  read_surface(const std::string &input);
  void
  read_table(const std::string &input);
  void
  read_unv_file(const std::string &input);

  /// Whether @p action ends without refusing its input.
  template <typename Action>
  bool
  is_accepted(const Action &action)
  {
    try
      {
        action();
        return true;
      }
    catch (const corotet::Error &)
      {
        return false;
      }
  }

  /// Ends the process if @p is_so is false: a promise that must hold for any
  /// input is broken.
  inline void
  require(const bool is_so, const std::string &what)
  {
    if (is_so)
      return;
    std::fprintf(stderr, "fuzz: broken promise: %s\n", what.c_str());
    std::abort();
  }

  /// A temporary folder of this process.
  inline const TemporaryFolder &
  scratch()
  {
    static const TemporaryFolder folder;
    return folder;
  }

  /// Writes a file of that folder and gives its path.
  inline std::string
  write(const std::string &name, const std::string &content)
  {
    const std::string path = scratch() / name;
    std::ofstream     file(path, std::ios::binary);
    file << content;
    file.close();
    if (!file)
      throw std::runtime_error(path + " cannot be written");
    return path;
  }
} // namespace fuzz

#endif
