// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_local_mesh_h
#define corotet_mesh_local_mesh_h

#include <corotet/mesh/edges.h>
#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/types.h>

#include <mpi.h>

#include <array>
#include <cstddef>
#include <vector>

namespace corotet
{
  /**
   * What a rank has of a mesh: the cells that it owns, and those beside them,
   * which share a vertex with one of its own. In the order of the mesh.
   */
  struct LocalMesh
  {
    /// Of a face that no other local cell has.
    static constexpr unsigned int no_cell =
      dealii::numbers::invalid_unsigned_int;

    bool
    is_owned(const unsigned int cell) const
    {
      return owners[cell] == rank;
    }

    MPI_Comm     communicator   = MPI_COMM_NULL;
    unsigned int rank           = 0;
    std::size_t  n_global_cells = 0;

    std::vector<dealii::Point<3>> vertices;
    /// With numbers of local vertices and local curves.
    std::vector<SerialMesh::Cell> cells;
    /// Of each cell, its number in the mesh, ascending, and the rank that owns
    /// it.
    std::vector<dealii::types::coarse_cell_id> numbers;
    std::vector<dealii::types::subdomain_id>   owners;

    /// The cell behind each face, as corners_of_faces numbers them, or no_cell:
    /// that is the surface of the body, or for ghost cells also where the known
    /// part of the mesh ends.
    std::vector<std::array<unsigned int, 4>> neighbors;

    /// Faces of all cells on named boundaries; named edges and vertices of the
    /// owned cells. Each list by cells, ascending.
    std::vector<CellPart> faces;
    std::vector<CellPart> edges;
    std::vector<CellPart> corners;

    /// As in SerialMesh, of the local cells.
    unsigned int                  geometry_degree = 1;
    std::vector<dealii::Point<3>> curved_nodes;
  };

  /**
   * Distributes a checked mesh that rank 0 has. Each rank owns a piece of the
   * sequence of cells, all pieces with equal work; so the cells should be
   * sorted along a curve. Rank 0 must have at least as many cells as there are
   * ranks; it makes the part of one rank at a time. Collective.
   */
  LocalMesh
  distribute(const SerialMesh &mesh, const MPI_Comm comm);
} // namespace corotet

#endif
