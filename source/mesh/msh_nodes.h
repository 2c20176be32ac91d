// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_msh_nodes_h
#define corotet_source_mesh_msh_nodes_h

#include <corotet/mesh/curved_cells.h>

#include <algorithm>
#include <map>
#include <vector>

/**
 * The nodes of a mesh as gmsh's files have them.
 */
namespace corotet
{
  // A node of a gmsh element, given by the corners whose mean it is on a
  // straight element. Of three corners two may be the same.
  using MshNode = std::vector<unsigned int>;

  // The nodes of elements of degree 1, 2 and 3, in gmsh's order.
  extern const std::vector<MshNode> line_nodes[3], triangle_nodes[3],
    tetrahedron_nodes[3];

  // A node of the mesh, given by the vertices whose mean it would be on
  // straight cells, ascending.
  using NodeKey = std::vector<unsigned int>;

  template <std::size_t n>
  NodeKey
  key_of(const std::array<unsigned int, n> &vertices, const MshNode &node)
  {
    NodeKey key;
    for (const unsigned int corner : node)
      key.push_back(vertices[corner]);
    std::sort(key.begin(), key.end());
    return key;
  }



  // All nodes of a mesh whose cells are all written with the same degree,
  // vertices first.
  class MshNodes
  {
  public:
    explicit MshNodes(const SerialMesh &mesh)
      : mesh(mesh)
      , degree(mesh.geometry_degree)
      , positions(mesh.vertices)
    {
      if (degree == 1)
        return;
      // Curved cells come first: if a curved and a straight cell share a face,
      // the curved one gives the positions of its nodes.
      for (const bool curved : {true, false})
        for (const SerialMesh::Cell &cell : mesh.cells)
          if ((cell.curve != SerialMesh::straight) == curved)
            add(cell);
    }

    // The tag of a node, counted from 1.
    template <std::size_t n>
    std::size_t
    tag(const std::array<unsigned int, n> &vertices, const MshNode &node) const
    {
      return 1 + (node.size() == 1 ? vertices[node[0]] :
                                     numbers.at(key_of(vertices, node)));
    }

    const std::vector<dealii::Point<3>> &
    all() const
    {
      return positions;
    }

  private:
    void
    add(const SerialMesh::Cell &cell)
    {
      for (const MshNode &node : tetrahedron_nodes[degree - 1])
        if (node.size() > 1 &&
            numbers.emplace(key_of(cell.vertices, node), positions.size())
              .second)
          positions.push_back(position(cell, node));
    }

    dealii::Point<3>
    position(const SerialMesh::Cell &cell, const MshNode &node) const
    {
      // The position in the reference cell, and on a straight cell.
      dealii::Point<3> xi, x;
      for (const unsigned int corner : node)
        {
          if (corner > 0)
            xi[corner - 1] += 1. / node.size();
          x += mesh.vertices[cell.vertices[corner]] / double(node.size());
        }
      if (cell.curve == SerialMesh::straight)
        return x;
      const auto nearest =
        std::min_element(points.begin(),
                         points.end(),
                         [&](const dealii::Point<3> &a,
                             const dealii::Point<3> &b) {
                           return xi.distance(a) < xi.distance(b);
                         });
      return curved_nodes(mesh, cell)[nearest - points.begin()];
    }

    const SerialMesh                   &mesh;
    const unsigned int                  degree;
    const std::vector<dealii::Point<3>> points = map_points(degree);
    std::map<NodeKey, std::size_t>      numbers;
    std::vector<dealii::Point<3>>       positions;
  };
} // namespace corotet

#endif
