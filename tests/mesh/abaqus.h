// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_abaqus_h
#define corotet_tests_mesh_abaqus_h

#include <corotet/mesh/abaqus_file.h>

#include <gtest/gtest.h>

#include "mesh/tools.h"
#include "mesh/two_cubes.h"

namespace corotet::tests
{
  using Known = std::vector<std::string>;

  class AbaqusFile : public testing::Test
  {
  protected:
    SerialMesh
    read(const std::string &text, const std::string &name = "part.inp") const
    {
      return serial_mesh(read_abaqus_file(folder.write(name, text)));
    }

    // The message of the refusal, without the folder.
    std::string
    message(const std::string &text) const
    {
      const std::string found = refusal([&] { read(text); });
      const std::size_t file  = found.find("part.inp");
      return file == std::string::npos ? found : found.substr(file);
    }

    TemporaryFolder folder;
  };

  // Two tetrahedra that share a face, with numbers that leave gaps.
  inline const std::string nodes = "*Node\n"
                                   "  10, 0., 0., 0.\n"
                                   " 20, 1.D0, 0, 0\n"
                                   "30,0,+1e0,0\n"
                                   "40, 0, 0, 1.\n"
                                   "** a comment\n"
                                   "50, 1, 1, 1\n";
  inline const std::string cells = "*ELEMENT, type=C3D4, ELSET=Body\n"
                                   "7, 10, 20, 30, 40\n"
                                   "9, 20, 30, 40, 50\n";

  inline Known
  known_regions(const SerialMesh &mesh)
  {
    return MeshNames("region", mesh.regions).known();
  }
} // namespace corotet::tests

#endif
