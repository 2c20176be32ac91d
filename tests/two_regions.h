// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_two_regions_h
#define corotet_tests_two_regions_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet::tests
{
  /// Puts cells whose centre is below @p x into region 1, and the others into
  /// region 2.
  inline SerialMesh
  in_two_regions(SerialMesh         mesh,
                 const double       x,
                 const std::string &first,
                 const std::string &second)
  {
    for (SerialMesh::Cell &cell : mesh.cells)
      {
        double centre = 0;
        for (const unsigned int v : cell.vertices)
          centre += mesh.vertices[v][0] / 4;
        cell.region = centre < x ? 1 : 2;
      }
    mesh.regions.names = {{1, first}, {2, second}};
    return mesh;
  }
} // namespace corotet::tests

#endif
