// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Whether cells of degree 2 and 3 agree on the nodes of the edges and faces
// that they share.

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <vector>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Nodes of two curved cells at the same place of an edge or a face may be
    // as far apart as this part of the edge.
    constexpr double round_off = 1e-6;
    // Between a curved cell and a straight one this part of the cells' longest
    // edge is allowed: cells that are straight up to the digits of a file,
    // which are not more, have become straight.
    constexpr double of_digits = 5e-3;



    // An edge or a face of the reference cell, and the nodes of the map inside
    // of it.
    struct Side
    {
      std::vector<unsigned int> corners;
      // The nodes, and the weight of each corner in their positions.
      std::vector<unsigned int>          nodes;
      std::vector<std::array<double, 3>> weights;
    };



    // The edges and faces that have nodes of a map of this degree inside.
    std::vector<Side>
    sides_with_nodes(const unsigned int degree)
    {
      std::vector<Side> sides;
      for (unsigned int b = 0; b < 4; ++b)
        for (unsigned int a = 0; a < b; ++a)
          {
            sides.push_back({{a, b}, {}, {}});
            for (unsigned int c = 0; c < a && degree > 2; ++c)
              sides.push_back({{c, a, b}, {}, {}});
          }
      const std::vector<Point<3>> points = map_points(degree);
      for (unsigned int i = 4; i < points.size(); ++i)
        {
          const Point<3> &x      = points[i];
          const double lambda[4] = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
          std::vector<unsigned> corners;
          std::array<double, 3> weights{};
          for (unsigned int v = 0; v < 4; ++v)
            if (lambda[v] > 1e-10)
              {
                if (corners.size() < 3)
                  weights[corners.size()] = lambda[v];
                corners.push_back(v);
              }
          for (Side &side : sides)
            if (side.corners == corners)
              {
                side.nodes.push_back(i);
                side.weights.push_back(weights);
              }
        }
      return sides;
    }



    // Compares the nodes of cells on their common edges and faces.
    class CommonNodes
    {
    public:
      explicit CommonNodes(const MeshCells &mesh)
        : mesh(mesh)
        , sides(sides_with_nodes(mesh.geometry_degree))
      {}

      // Describes the first disagreement; empty if there is none.
      std::string
      disagreement() const
      {
        const std::vector<bool> ends = ends_of_bent_sides();
        if (std::find(ends.begin(), ends.end(), true) == ends.end())
          return "";
        // The sides between such ends, in the order of their first corners.
        std::vector<std::size_t> starts(mesh.vertices.size() + 1);
        const auto               for_each = [&](const auto &action) {
          for (unsigned int c = 0; c < mesh.cells.size(); ++c)
            {
              const auto is_end = [&](const unsigned int v) {
                return v == no_corner || ends[v];
              };
              const auto &vertices = mesh.cells[c].vertices;
              if (std::count_if(vertices.begin(), vertices.end(), is_end) < 2)
                continue;
              for (unsigned int s = 0; s < sides.size(); ++s)
                if (const Corners corners = sorted_corners(c, s);
                    std::all_of(corners.begin(), corners.end(), is_end))
                  action(c, s, corners);
            }
        };
        for_each([&](const unsigned int,
                     const unsigned int,
                     const Corners &corners) { ++starts[corners[0] + 1]; });
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
          starts[v + 1] += starts[v];
        std::vector<Part>        parts(starts.back());
        std::vector<std::size_t> next(starts.begin(), starts.end() - 1);
        for_each([&](const unsigned int c,
                     const unsigned int s,
                     const Corners     &corners) {
          parts[next[corners[0]]++] = {{{corners[1], corners[2]}}, c, s};
        });
        for (std::size_t v = 0; v < mesh.vertices.size(); ++v)
          {
            const auto begin = parts.begin() + starts[v];
            const auto end   = parts.begin() + starts[v + 1];
            std::sort(begin, end, [](const Part &a, const Part &b) {
              return std::tie(a.others, a.cell) < std::tie(b.others, b.cell);
            });
            for (auto part = begin; part < end; ++part)
              if (part != begin && part->others == (part - 1)->others)
                if (const std::string text = difference(*(part - 1), *part);
                    !text.empty())
                  return text;
          }
        return "";
      }

    private:
      static constexpr unsigned int no_corner = MeshCells::straight;

      // Numbers of vertices in ascending order; of an edge the last is
      // no_corner.
      using Corners = std::array<unsigned int, 3>;

      // A side of a cell, and its corners but the first one.
      struct Part
      {
        std::array<unsigned int, 2> others;
        unsigned int                cell;
        unsigned int                side;
      };

      Corners
      sorted_corners(const unsigned int cell, const unsigned int side) const
      {
        Corners result{{no_corner, no_corner, no_corner}};
        for (unsigned int i = 0; i < sides[side].corners.size(); ++i)
          result[i] = mesh.cells[cell].vertices[sides[side].corners[i]];
        std::sort(result.begin(), result.end());
        return result;
      }

      double
      longest_edge(const unsigned int cell) const
      {
        return std::sqrt(
          square_of_longest_edge(cell_vertices(mesh, mesh.cells[cell])));
      }

      // The positions of the nodes of a side less those in a straight cell.
      // Those of an edge are in the order from its vertex with the lower number
      // to the other one. Where there is no second node its offset is zero.
      std::array<Tensor<1, 3>, 2>
      offsets(const unsigned int cell, const unsigned int side) const
      {
        const auto &[corners, nodes, weights] = sides[side];
        std::array<Tensor<1, 3>, 2> result;
        const MeshCells::Cell      &of = mesh.cells[cell];
        if (of.curve == MeshCells::straight)
          return result;
        for (unsigned int i = 0; i < nodes.size(); ++i)
          {
            result[i] = curved_nodes(mesh, of)[nodes[i]];
            for (unsigned int k = 0; k < corners.size(); ++k)
              result[i] -=
                weights[i][k] * mesh.vertices[of.vertices[corners[k]]];
          }
        // Of the two nodes of an edge of degree 3 the one closer to the lower
        // vertex comes first.
        if (nodes.size() == 2 &&
            (of.vertices[corners[0]] < of.vertices[corners[1]]) !=
              (weights[0][0] > weights[0][1]))
          std::swap(result[0], result[1]);
        return result;
      }

      // The length of a side's first edge.
      double
      length(const unsigned int cell, const unsigned int side) const
      {
        const auto &v       = mesh.cells[cell].vertices;
        const auto &corners = sides[side].corners;
        return mesh.vertices[v[corners[0]]].distance(
          mesh.vertices[v[corners[1]]]);
      }

      // The vertices at which sides end that are not straight in a cell.
      std::vector<bool>
      ends_of_bent_sides() const
      {
        std::vector<bool> ends(mesh.vertices.size());
        for (unsigned int c = 0; c < mesh.cells.size(); ++c)
          if (mesh.cells[c].curve != MeshCells::straight)
            for (unsigned int s = 0; s < sides.size(); ++s)
              for (const Tensor<1, 3> &offset : offsets(c, s))
                if (offset.norm() > 0.5 * round_off * length(c, s))
                  for (const unsigned int corner : sides[s].corners)
                    ends[mesh.cells[c].vertices[corner]] = true;
        return ends;
      }

      // Describes how the nodes of a side differ in two cells; empty if they do
      // not.
      std::string
      difference(const Part &a, const Part &b) const
      {
        const auto of_a = offsets(a.cell, a.side);
        const auto of_b = offsets(b.cell, b.side);
        const bool has_straight =
          mesh.cells[a.cell].curve == MeshCells::straight ||
          mesh.cells[b.cell].curve == MeshCells::straight;
        const double allowed =
          has_straight ?
            of_digits * std::max(longest_edge(a.cell), longest_edge(b.cell)) :
            round_off * length(a.cell, a.side);
        for (unsigned int i = 0; i < of_a.size(); ++i)
          if ((of_a[i] - of_b[i]).norm() > allowed)
            {
              const Side &side = sides[a.side];
              Point<3>    x;
              const auto &v = mesh.cells[a.cell].vertices;
              // The middle of the side in a straight cell.
              for (const unsigned int corner : side.corners)
                x += mesh.vertices[v[corner]] / double(side.corners.size());
              return fmt::format(
                "cells with a common {} have different nodes there: found nodes "
                "that are {:.3g} apart near {}; allowed is one place for all cells",
                side.corners.size() == 2 ? "edge" : "face",
                (of_a[i] - of_b[i]).norm(),
                position(x));
            }
        return "";
      }

      const MeshCells        &mesh;
      const std::vector<Side> sides;
    };
  } // namespace



  void
  check_common_nodes(const MeshCells &mesh, const std::string &origin)
  {
    if (mesh.geometry_degree == 1)
      return;
    if (const std::string text = CommonNodes(mesh).disagreement();
        !text.empty())
      refuse_mesh(origin, text);
  }
} // namespace corotet
