// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/finite_element.h>
#include <corotet/discretization/local_nodes.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  using dealii::numbers::invalid_unsigned_int;

  namespace
  {
    // The place of a node of the element: the vertex, edge (ends_of_edges) or
    // face (corners_of_faces) with this number, or the inside of the cell.
    struct NodePlace
    {
      unsigned int dimension;
      unsigned int number;
      // For an edge with two nodes: whether this is the one at the first end.
      bool at_first_end;
    };



    NodePlace
    place_of(const dealii::Point<3> &x)
    {
      const std::array<double, 4> lambda{
        {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]}};
      const auto vanishes = [&](const unsigned int v) {
        return std::abs(lambda[v]) < 1e-10;
      };
      std::vector<unsigned int> corners;
      for (unsigned int v = 0; v < 4; ++v)
        if (!vanishes(v))
          corners.push_back(v);
      const auto is_at = [&](const auto &vertices) {
        return std::is_permutation(vertices.begin(),
                                   vertices.end(),
                                   corners.begin(),
                                   corners.end());
      };
      unsigned int number = corners[0];
      bool         first  = false;
      if (corners.size() == 2)
        {
          number =
            std::find_if(ends_of_edges.begin(), ends_of_edges.end(), is_at) -
            ends_of_edges.begin();
          const auto [a, b] = ends_of_edges[number];
          first             = lambda[a] > lambda[b] + 1e-10;
        }
      else if (corners.size() == 3)
        number = std::find_if(corners_of_faces.begin(),
                              corners_of_faces.end(),
                              is_at) -
                 corners_of_faces.begin();
      return {static_cast<unsigned int>(corners.size()) - 1, number, first};
    }



    // Sets the numbers of the edges of each cell; returns the number of edges.
    unsigned int
    number_edges(const LocalMesh                          &mesh,
                 std::vector<std::array<unsigned int, 6>> &edges)
    {
      // The edges are kept in lists, one for each vertex that is their lower
      // end.
      struct Edge
      {
        unsigned int higher_end;
        unsigned int next;
      };
      std::vector<unsigned int> first(mesh.vertices.size(),
                                      invalid_unsigned_int);
      std::vector<Edge>         found;
      edges.reserve(mesh.cells.size());
      for (const SerialMesh::Cell &cell : mesh.cells)
        {
          std::array<unsigned int, 6> &numbers = edges.emplace_back();
          for (unsigned int e = 0; e < 6; ++e)
            {
              const auto [a, b] =
                ascending_ends(cell.vertices[ends_of_edges[e][0]],
                               cell.vertices[ends_of_edges[e][1]]);
              unsigned int edge = first[a];
              while (edge != invalid_unsigned_int &&
                     found[edge].higher_end != b)
                edge = found[edge].next;
              if (edge == invalid_unsigned_int)
                {
                  edge = found.size();
                  found.push_back({b, first[a]});
                  first[a] = edge;
                }
              numbers[e] = edge;
            }
        }
      return found.size();
    }



    // Sets the numbers of the faces of each cell; returns the number of faces.
    // Faces at the end of the known part of the mesh have one cell.
    unsigned int
    number_faces(const LocalMesh                          &mesh,
                 std::vector<std::array<unsigned int, 4>> &faces)
    {
      unsigned int n = 0;
      faces.resize(mesh.cells.size());
      for (unsigned int c = 0; c < mesh.cells.size(); ++c)
        for (unsigned int f = 0; f < 4; ++f)
          {
            const unsigned int other = mesh.neighbors[c][f];
            if (other == LocalMesh::no_cell || other > c)
              faces[c][f] = n++;
            else
              faces[c][f] =
                faces[other][std::find(mesh.neighbors[other].begin(),
                                       mesh.neighbors[other].end(),
                                       c) -
                             mesh.neighbors[other].begin()];
          }
      return n;
    }
  } // namespace



  LocalNodes::LocalNodes(const LocalMesh &mesh, const Element element)
    : n_per_cell(element.n_nodes())
  {
    std::vector<NodePlace>      places;
    std::array<unsigned int, 4> n_of_dimension{};
    for (const auto &x : finite_element(element).get_unit_support_points())
      {
        places.push_back(place_of(x));
        ++n_of_dimension[places.back().dimension];
      }
    const unsigned int n_per_edge = n_of_dimension[1] / 6;
    const unsigned int n_cells    = mesh.cells.size();

    std::vector<std::array<unsigned int, 6>> edges;
    std::vector<std::array<unsigned int, 4>> faces;
    const unsigned int                       on_edges = mesh.vertices.size();
    const unsigned int                       on_faces =
      on_edges + (n_per_edge > 0 ? n_per_edge * number_edges(mesh, edges) : 0);
    const unsigned int inside =
      on_faces + (n_of_dimension[2] > 0 ? number_faces(mesh, faces) : 0);

    of_cells.reserve(std::size_t(n_cells) * n_per_cell);
    owners.assign(inside + n_of_dimension[3] * n_cells,
                  dealii::numbers::invalid_subdomain_id);
    for (unsigned int c = 0; c < n_cells; ++c)
      for (const auto &[dimension, number, at_first_end] : places)
        {
          const auto  &vertices = mesh.cells[c].vertices;
          unsigned int node     = invalid_unsigned_int;
          switch (dimension)
            {
              case 0:
                node = vertices[number];
                break;
              case 1:
                {
                  // The first node of an edge is at the end with the lower
                  // vertex number.
                  const auto [a, b] = ends_of_edges[number];
                  const bool is_first =
                    (vertices[a] < vertices[b]) == at_first_end;
                  node = on_edges + n_per_edge * edges[c][number] +
                         (n_per_edge == 2 && !is_first ? 1 : 0);
                  break;
                }
              case 2:
                node = on_faces + faces[c][number];
                break;
              default:
                node = inside + c;
            }
          of_cells.push_back(node);
          owners[node] = std::min(owners[node], mesh.owners[c]);
        }
  }
} // namespace corotet
