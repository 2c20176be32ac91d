// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_simulation_two_cubes_h
#define corotet_tests_simulation_two_cubes_h

#include "../body.h"
#include "../joined_meshes.h"

namespace corotet::tests
{
  /// The unit cube and a shifted copy, with common vertices where they meet.
  /// The region of the copy is 'second', its boundaries are 'second x-min' and
  /// so on.
  inline SerialMesh
  two_cubes(const dealii::Tensor<1, 3> &shift)
  {
    SerialMesh             mesh    = box("1, 1, 1", "1, 1, 1");
    const SerialMesh       one     = mesh;
    const auto             numbers = add_mesh(mesh, one, shift);
    constexpr unsigned int other   = 50;
    for (std::size_t c = one.cells.size(); c < mesh.cells.size(); ++c)
      mesh.cells[c].region = other;
    for (auto face : one.faces)
      {
        for (unsigned int &v : face.vertices)
          v = numbers[v];
        face.boundary += other;
        mesh.faces.push_back(face);
      }
    mesh.regions.names[other] = "second";
    for (const auto &[id, name] : one.boundaries.names)
      mesh.boundaries.names[id + other] = "second " + name;
    return mesh;
  }
} // namespace corotet::tests

#endif
