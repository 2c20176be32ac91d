// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_sources_h
#define corotet_mesh_mesh_sources_h

#include <corotet/base/selectable.h>
#include <corotet/mesh/mesh_source.h>

namespace corotet
{
  /**
   * All mesh sources, by the names that a parameter file selects them by:
   * the library's, and what programs have added (AddedCandidate).
   */
  std::vector<Candidate<MeshSource>>
  mesh_sources();
} // namespace corotet

#endif
