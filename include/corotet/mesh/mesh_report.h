// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_report_h
#define corotet_mesh_mesh_report_h

#include <corotet/mesh/serial_mesh.h>

#include <string>

namespace corotet
{
  /**
   * A report on a checked mesh as lines of text: its size and remarks, the
   * quality of its cells (of the straight cells with the same vertices), and
   * all names with volumes, areas, lengths and positions. Lengths are in the
   * unit of the file.
   */
  std::string
  mesh_report(const SerialMesh &mesh);
} // namespace corotet

#endif
