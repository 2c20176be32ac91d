// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_hdf5_mesh_version_h
#define corotet_mesh_hdf5_mesh_version_h

namespace corotet
{
  /// Of the files that are written, the only one that is read.
  constexpr int hdf5_mesh_version = 1;
} // namespace corotet

#endif
