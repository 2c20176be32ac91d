// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_local_mesh_h
#define corotet_mesh_local_mesh_h

#include <corotet/mesh/edges.h>
#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/types.h>

#include <mpi.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Some of the cells of a mesh that is spread over the ranks, with numbers of
   * vertices that are those of this part.
   */
  struct MeshPart : MeshCells
  {
    /// Of each cell, its number in the mesh.
    std::vector<std::uint64_t> numbers;
    /// Of each vertex, what all ranks know it by.
    std::vector<std::uint64_t> vertex_numbers;

    /// What has a name: faces on boundaries, edges and vertices. Each list by
    /// cells, ascending.
    std::vector<CellPart> faces;
    std::vector<CellPart> edges;
    std::vector<CellPart> corners;
  };

  /**
   * What a rank has of a mesh: the cells that it owns, and those beside them,
   * which share a vertex with one of its own. In the order of the mesh, the
   * vertices in the order in which the cells of the mesh meet them. A vertex is
   * known by that: 4 c + k if cell c is the first that has it, as corner k.
   *
   * Named are faces of all cells, edges and vertices of the owned ones.
   */
  struct LocalMesh : MeshPart
  {
    /// Of a face that no other local cell has.
    static constexpr unsigned int no_cell =
      dealii::numbers::invalid_unsigned_int;

    bool
    is_owned(const unsigned int cell) const
    {
      return owners[cell] == rank;
    }

    MPI_Comm      communicator   = MPI_COMM_NULL;
    unsigned int  rank           = 0;
    std::uint64_t n_global_cells = 0;

    /// Of each cell, the rank that owns it.
    std::vector<dealii::types::subdomain_id> owners;

    /// The cell behind each face, as corners_of_faces numbers them, or no_cell:
    /// that is the surface of the body, or for ghost cells also where the known
    /// part of the mesh ends.
    std::vector<std::array<unsigned int, 4>> neighbors;
  };

  /**
   * Adds the cells beside those of this rank to a part that sort_along_curve()
   * or partition_graph() has made. Throws an InputError if cells overlap, as
   * check_mesh() does. Collective.
   */
  LocalMesh
  with_cells_beside(MeshPart         &&part,
                    const std::string &origin,
                    const MPI_Comm     comm);

  /// The part of check_mesh() that finds where cells do not fit together.
  /// Collective.
  void
  check_surface_on_ranks(const LocalMesh &mesh, const std::string &origin);

  /// The cells that a rank owns.
  MeshPart
  owned_part(const LocalMesh &mesh);

  /**
   * Distributes a checked mesh that rank 0 has: each rank owns a piece of the
   * sequence of cells along a curve, all pieces with equal work. Collective.
   */
  LocalMesh
  distribute(SerialMesh mesh, const MPI_Comm comm);
} // namespace corotet

#endif
