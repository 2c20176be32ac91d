// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_edges_h
#define corotet_mesh_edges_h

#include <corotet/mesh/serial_mesh.h>

#include <array>
#include <utility>
#include <vector>

namespace corotet
{
  /// The vertices of a tetrahedron at the ends of its edges.
  constexpr std::array<std::array<unsigned int, 2>, 6> ends_of_edges{
    {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};

  /// The vertices at the corners of its faces, in ascending order; faces have
  /// deal.II's numbers.
  constexpr std::array<std::array<unsigned int, 3>, 4> corners_of_faces{
    {{{0, 1, 2}}, {{0, 1, 3}}, {{0, 2, 3}}, {{1, 2, 3}}}};

  /// A part of a cell with a name: a face, by its number in corners_of_faces,
  /// an edge, by its number in ends_of_edges, or a vertex.
  struct CellPart
  {
    unsigned int cell;
    unsigned int number;
    unsigned int id;
  };

  /// The named parts of cells, each list in ascending order of cells.
  struct NamedParts
  {
    std::vector<CellPart> faces;
    std::vector<CellPart> edges;
    std::vector<CellPart> corners;
  };

  /**
   * Finds the faces on named boundaries, named edges and corners of a mesh,
   * which must outlive this object, in its cells.
   */
  class PartsOfCells
  {
  public:
    explicit PartsOfCells(const SerialMesh &mesh);

    /// Whether a vertex of the cell is on a part with a name.
    bool
    may_have_names(const SerialMesh::Cell &cell) const
    {
      const auto [a, b, c, d] = cell.vertices;
      return (is_on[a] | is_on[b] | is_on[c] | is_on[d]) != 0;
    }

    /// Append the parts of a cell; @p name is the number of the cell in the
    /// appended parts.
    void
    add_faces(std::vector<CellPart>  &parts,
              const SerialMesh::Cell &cell,
              const unsigned int      name) const;
    void
    add_edges(std::vector<CellPart>  &parts,
              const SerialMesh::Cell &cell,
              const unsigned int      name) const;
    void
    add_corners(std::vector<CellPart>  &parts,
                const SerialMesh::Cell &cell,
                const unsigned int      name) const;

    /// The indices in SerialMesh::edges of the edges between two vertices,
    /// given in any order.
    std::vector<std::size_t>
    edges_between(const unsigned int a, const unsigned int b) const;

  private:
    using Ends = std::array<unsigned int, 2>;

    const SerialMesh &mesh;
    /// The ascending vertices of each face, and its boundary; sorted.
    std::vector<std::pair<std::array<unsigned int, 3>, unsigned int>> faces;
    /// The ascending ends of each edge, and its index; sorted.
    std::vector<std::pair<Ends, std::size_t>> edges;
    /// The vertex and id of each corner; sorted.
    std::vector<Ends> corners;
    /// Whether each vertex is on a face, the end of an edge, or a corner (bits
    /// of a number): most vertices are not.
    std::vector<unsigned char> is_on;
  };

  /// The ends of an edge in ascending order, which identify it.
  std::array<unsigned int, 2>
  ascending_ends(const unsigned int a, const unsigned int b);

  /// The vertices of a face in ascending order, which identify it.
  std::array<unsigned int, 3>
  ascending_vertices(std::array<unsigned int, 3> vertices);

  /// All named parts of the cells of a mesh.
  NamedParts
  named_parts(const SerialMesh &mesh);
} // namespace corotet

#endif
