// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_hdf5_mesh_h
#define corotet_mesh_hdf5_mesh_h

#include <corotet/mesh/spread_mesh.h>

#include <string>

namespace corotet
{
  /**
   * Reads a mesh from a file that write_hdf5_mesh() has written: each rank
   * reads a piece of the sequence of cells, all pieces with the same number of
   * cells. Throws an InputError if it is another or a damaged file; cells are
   * not checked. Collective.
   *
   * The tables of the file: "vertices" with three coordinates of each vertex;
   * "cells" with four vertices of each cell; "regions" with the region of each
   * cell; "curves" with its number among the curved cells or -1; "curved_nodes"
   * with three coordinates of each node of a curved cell's map; "faces",
   * "edges" and "corners" with the cell, the number in it (as in CellPart) and
   * the id of each named part, sorted by cells; "description", a text in JSON
   * with the version, the degree of the maps, the names, and the ids of
   * "faceted" boundaries (remark_facets()).
   */
  SpreadMesh
  read_hdf5_mesh(const std::string &path, const MPI_Comm comm);

  /// Reads the whole mesh on one rank.
  SerialMesh
  read_hdf5_mesh(const std::string &path);

  /// Whether a file is such a mesh file, or claims to be.
  bool
  is_hdf5_mesh(const std::string &path);

  /// Writes a checked mesh to a file that is complete or absent, with the cells
  /// sorted along a curve. Throws MachineError if the file cannot be written.
  void
  write_hdf5_mesh(const std::string &path, const SerialMesh &mesh);
} // namespace corotet

#endif
