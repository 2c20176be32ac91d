// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The list of targets, and libFuzzer's way to call them
// (https://llvm.org/docs/LibFuzzer.html). The variable COROTET_FUZZ_TARGET
// names the target to run.

#include "targets.h"

#include <deal.II/base/mpi.h>

#include <hdf5.h>

#include <cstdint>
#include <iostream>

namespace fuzz
{
  const std::map<std::string, Target> &
  targets()
  {
    static const std::map<std::string, Target> all{
      {"abaqus_files", read_abaqus_input},
      {"checkpoints", read_checkpoint},
      {"expressions", read_expression},
      {"geometries", read_geometry},
      {"gmsh_models", read_gmsh_model},
      {"hdf5_meshes", read_hdf5_file},
      {"lists", read_list},
      {"medit_files", read_medit_file},
      {"mesh_files", read_mesh_file},
      {"nastran_files", read_nastran_file},
      {"parameters", read_parameters},
      {"surfaces", read_surface},
      {"tables", read_table},
      {"unv_files", read_unv_file}};
    return all;
  }

  void
  initialize()
  {
    // Shared memory is not used, as it would stay behind after a crash.
    setenv("OMPI_MCA_btl", "self", 0);
    static char                                     name[]  = "fuzz_targets";
    static char                                    *words[] = {name, nullptr};
    static char                                   **first   = words;
    static int                                      n_words = 1;
    static dealii::Utilities::MPI::MPI_InitFinalize mpi(n_words, first, 1);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
} // namespace fuzz

extern "C" int
LLVMFuzzerInitialize(int * /*argc*/, char *** /*argv*/)
{
  fuzz::initialize();
  return 0;
}

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  static const fuzz::Target target = [] {
    const char *const name  = std::getenv("COROTET_FUZZ_TARGET");
    const auto        found = fuzz::targets().find(name == nullptr ? "" : name);
    if (found == fuzz::targets().end())
      {
        std::cerr << "COROTET_FUZZ_TARGET must be one of:";
        for (const auto &[known, function] : fuzz::targets())
          std::cerr << ' ' << known;
        std::cerr << '\n';
        std::exit(1);
      }
    return found->second;
  }();
  target({reinterpret_cast<const char *>(data), size});
  return 0;
}
