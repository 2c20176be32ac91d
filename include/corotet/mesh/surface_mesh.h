// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_surface_mesh_h
#define corotet_mesh_surface_mesh_h

#include <corotet/mesh/gmsh_model.h>
#include <corotet/mesh/mesh_format.h>
#include <corotet/mesh/serial_mesh.h>

namespace corotet
{
  /**
   * The mesh of the bodies inside of the triangles of a file: STL, PLY, OBJ or
   * OFF. The surface is mended and checked (mend_surface(),
   * check_intersections()). Without GmshRequest::element_size its triangles
   * become faces of the cells; otherwise gmsh covers the shape with new
   * triangles between its edges, where normals differ by more than
   * GmshRequest::feature_angle.
   *
   * Boundaries are the patches between these edges, "surface 1" and so on in
   * the order of the file, and the file's named sets of triangles. Several
   * bodies become regions "solid 1" and so on, and a name of the file that all
   * triangles around a body have is also a name of its region. Throws
   * InputError.
   */
  SerialMesh
  mesh_of_surface(const GmshRequest &request, const MeshFormat format);
} // namespace corotet

#endif
