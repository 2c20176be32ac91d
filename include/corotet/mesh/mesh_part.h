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
   * Cuts smaller parts out of a part, one after another.
   */
  class PartCutter
  {
  public:
    /// @p part must outlive this object and must not change.
    explicit PartCutter(const MeshPart &part);

    /// The part with these different cells, in this order, and their vertices
    /// in the order in which the cells use them.
    MeshPart
    cut(const std::vector<unsigned int> &cells);

  private:
    const MeshPart &part;
    /// The new numbers of vertices and cells while a part is cut.
    std::vector<unsigned int> new_vertices;
    std::vector<unsigned int> new_cells;
  };

  /**
   * Joins cells of some parts, each given by the part and its number there, in
   * this order. Vertices with the same number become one, in the order in which
   * the cells use them.
   */
  MeshPart
  merged(const std::vector<MeshPart>                              &parts,
         const std::vector<std::pair<unsigned int, unsigned int>> &order);

  /// Sorts the vertices by their numbers.
  void
  sort_vertices(MeshPart &part);

  /// Writes a part as a message, and reads a part from a message. Reading
  /// starts at @p position, which is moved behind the part.
  std::vector<std::byte>
  packed(const MeshPart &part);
  MeshPart
  unpacked(const std::vector<std::byte> &message, std::size_t &position);

  /**
   * The whole mesh as one part, with the named parts @p named_parts: cells and
   * vertices keep their numbers. Removes cells and vertices from @p mesh.
   */
  MeshPart
  whole_part(SerialMesh &mesh, NamedParts &&named_parts);

  /// The reverse of whole_part(), for a part that is a whole mesh.
  SerialMesh
  serial_mesh(MeshPart &&part);

  /**
   * Gives each rank a piece of the mesh that rank 0 has in @p whole, nearly the
   * piece that sort_along_curve() will give it. Rank 0 makes one piece at a
   * time. Collective.
   */
  MeshPart
  scatter(MeshPart &&whole, const MPI_Comm comm);
} // namespace corotet

#endif
