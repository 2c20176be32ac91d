// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_joined_meshes_h
#define corotet_tests_joined_meshes_h

#include <corotet/mesh/serial_mesh.h>

#include <vector>

namespace corotet::tests
{
  /// Adds the cells of another mesh, moved by @p shift, with common vertices
  /// where they meet. Names are those of @p mesh; the faces of @p other get
  /// none. Returns the new numbers of the vertices of @p other.
  inline std::vector<unsigned int>
  add_mesh(SerialMesh                 &mesh,
           const SerialMesh           &other,
           const dealii::Tensor<1, 3> &shift)
  {
    std::vector<unsigned int> numbers;
    for (const auto &vertex : other.vertices)
      {
        const auto   x = vertex + shift;
        unsigned int n = 0;
        while (n < mesh.vertices.size() &&
               (x - mesh.vertices[n]).norm() > 1e-10)
          ++n;
        if (n == mesh.vertices.size())
          mesh.vertices.push_back(x);
        numbers.push_back(n);
      }
    for (SerialMesh::Cell cell : other.cells)
      {
        for (unsigned int &v : cell.vertices)
          v = numbers[v];
        mesh.cells.push_back(cell);
      }
    return numbers;
  }
} // namespace corotet::tests

#endif
