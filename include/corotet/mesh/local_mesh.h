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
   * Some of the cells of a mesh that is spread over the ranks; vertices are
   * numbered within this part.
   */
  struct MeshPart : MeshCells
  {
    /// The number of each cell in the mesh.
    std::vector<std::uint64_t> numbers;
    /// The number by which all ranks know each vertex.
    std::vector<std::uint64_t> vertex_numbers;

    /// The named parts: faces on boundaries, edges and vertices. Each list is
    /// in ascending order of cells.
    std::vector<CellPart> faces;
    std::vector<CellPart> edges;
    std::vector<CellPart> corners;
  };

  /**
   * A rank's part of a mesh: the cells that it owns, and those beside them,
   * which share a vertex with one of its own. Cells are in the order of the
   * mesh, vertices in the order in which the cells of the mesh first use them.
   * That order gives a vertex the number by which all ranks know it: 4 c + k if
   * cell c is the first that has it, as corner k.
   *
   * Named parts are listed for faces of all cells, but for edges and vertices
   * of owned cells only.
   */
  struct LocalMesh : MeshPart
  {
    /// The neighbor of a face that no other local cell has.
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

    /// The rank that owns each cell.
    std::vector<dealii::types::subdomain_id> owners;

    /// The cell behind each face, as corners_of_faces numbers them, or no_cell:
    /// on the surface of the body, and for ghost cells also where the known
    /// part of the mesh ends.
    std::vector<std::array<unsigned int, 4>> neighbors;
  };

  /**
   * Adds the cells beside those of this rank to a part made by
   * sort_along_curve() or partition_graph(). Throws an InputError if cells
   * overlap, as check_mesh() does. Collective.
   */
  LocalMesh
  with_cells_beside(MeshPart         &&part,
                    const std::string &origin,
                    const MPI_Comm     comm);

  /// The part of check_mesh() that finds places where cells do not fit
  /// together. Collective.
  void
  check_surface_on_ranks(const LocalMesh &mesh, const std::string &origin);

  /// The cells that a rank owns, with their named parts.
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
