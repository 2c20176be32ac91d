// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_part_h
#define corotet_mesh_mesh_part_h

#include <corotet/mesh/local_mesh.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * Cuts parts out of a part, one after another.
   */
  class PartCutter
  {
  public:
    /// @p part must outlive this object, and stay as it is.
    explicit PartCutter(const MeshPart &part);

    /// These cells, each once, in their order, and their vertices in the order
    /// in which the cells meet them.
    MeshPart
    cut(const std::vector<unsigned int> &cells);

  private:
    const MeshPart &part;
    /// Of each vertex and cell, while a part is cut.
    std::vector<unsigned int> new_vertices;
    std::vector<unsigned int> new_cells;
  };

  /**
   * Cells of some parts, each given by the part and its number there, in this
   * order. Vertices with the same number become one, in the order in which
   * the cells meet them.
   */
  MeshPart
  merged(const std::vector<MeshPart>                              &parts,
         const std::vector<std::pair<unsigned int, unsigned int>> &order);

  /// By their numbers.
  void
  sort_vertices(MeshPart &part);

  /// A part as a message, and what stands in one from @p position on, which
  /// becomes what follows it.
  std::vector<std::byte>
  packed(const MeshPart &part);
  MeshPart
  unpacked(const std::vector<std::byte> &message, std::size_t &position);

  /**
   * The whole mesh as one part, with the names of @p named_parts: numbers are
   * those that cells and vertices have. Empties the mesh of cells and vertices.
   */
  MeshPart
  whole_part(SerialMesh &mesh, NamedParts &&named_parts);

  /// The other way round, for one that is a whole mesh.
  SerialMesh
  serial_mesh(MeshPart &&part);

  /**
   * Gives each rank a piece of the mesh that rank 0 has in @p whole, nearly the
   * one that sort_along_curve() will leave it. Rank 0 makes one at a time.
   * Collective.
   */
  MeshPart
  scatter(MeshPart &&whole, const MPI_Comm comm);
} // namespace corotet

#endif
