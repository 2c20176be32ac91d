// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_gmsh_surfaces_h
#define corotet_source_gmsh_surfaces_h

#include <corotet/mesh/gmsh_model.h>

#include <stdexcept>

namespace corotet::gmsh_program
{
  /**
   * Reads closed surfaces of triangles, and makes volumes between them that can
   * be meshed. With GmshRequest::element_size the surfaces get parameters so
   * that they can be meshed anew, too; otherwise their triangles stay.
   */
  void
  read_surface(const GmshRequest &request);

  /// Throws an error of gmsh about such a surface, together with advice for the
  /// user.
  [[noreturn]] void
  explain_surface(const GmshRequest &request, const std::runtime_error &error);
} // namespace corotet::gmsh_program

#endif
