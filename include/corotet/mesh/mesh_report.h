// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_report_h
#define corotet_mesh_mesh_report_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet
{
  /**
   * What a user wants to know of a checked mesh before computing on it, as
   * lines of text: its size and remarks, how well its cells are shaped (of the
   * straight cells with the same vertices), and the names that there are, with
   * volumes, areas and lengths and where they are. Lengths as the file has
   * them.
   */
  std::string
  mesh_report(const SerialMesh &mesh);
} // namespace corotet

#endif
