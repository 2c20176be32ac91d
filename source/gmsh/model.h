// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_gmsh_model_h
#define corotet_gmsh_model_h

#include <corotet/mesh/gmsh_model.h>

namespace corotet::gmsh_program
{
  /// Makes the model of a request by gmsh, which must be initialised. Throws
  /// what gmsh throws.
  GmshModel
  make_model(const GmshRequest &request);
} // namespace corotet::gmsh_program

#endif
