// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_curved_mesh_h
#define corotet_tests_curved_mesh_h

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_quality.h>

#include "body.h"

namespace corotet::tests
{
  /**
   * @p mesh with all vertices moved to @p map(x), and every cell given the map
   * of degree q that interpolates it. Straight cells keep such maps until
   * remove_straight_maps().
   */
  inline SerialMesh
  curved(SerialMesh                                                       mesh,
         const unsigned int                                               q,
         const std::function<dealii::Point<3>(const dealii::Point<3> &)> &map)
  {
    const std::vector<dealii::Point<3>> points = map_points(q);
    mesh.geometry_degree                       = q;
    for (SerialMesh::Cell &cell : mesh.cells)
      {
        const auto p = cell_vertices(mesh, cell);
        cell.curve   = mesh.curved_nodes.size() / points.size();
        for (const dealii::Point<3> &xi : points)
          {
            dealii::Point<3> x = p[0];
            for (unsigned int k = 0; k < 3; ++k)
              x += xi[k] * (p[k + 1] - p[0]);
            mesh.curved_nodes.push_back(map(x));
          }
      }
    for (dealii::Point<3> &x : mesh.vertices)
      x = map(x);
    return mesh;
  }

  /// The box [0, 2] x [0, 1] x [0, 1] of 4 x 2 x 2 cuboids, bent where x > 1:
  /// half of its cells are straight.
  inline SerialMesh
  half_curved_box(const unsigned int q)
  {
    SerialMesh mesh =
      curved(box("2, 1, 1", "4, 2, 2"), q, [](dealii::Point<3> x) {
        const double s = std::max(0., x[0] - 1);
        return dealii::Point<3>(x[0] + 0.2 * s * s * x[2],
                                x[1] + 0.3 * s * s * (1 + x[2] * x[1]),
                                x[2] - 0.25 * s * s * s * (x[0] - x[1]));
      });
    remove_straight_maps(mesh);
    return mesh;
  }

  /// An eighth of a sphere of radius 1 m with a hole at its pole, 4 mm thick,
  /// of n x n x 1 cuboids (five tetrahedra each). With n = 4 the distance of
  /// curved edges from their chords is up to ten times the thickness.
  inline SerialMesh
  thin_shell(const unsigned int n, const unsigned int q)
  {
    const std::string cells = std::to_string(n);
    return curved(box("1, 1, 1", cells + ", " + cells + ", 1"),
                  q,
                  [](const dealii::Point<3> &x) {
                    const double pole  = 0.3;
                    const double right = dealii::numbers::PI_2;
                    const double phi   = right * x[0];
                    const double theta = right - (right - pole) * x[1];
                    const double r     = 1 + 0.004 * (x[2] - 0.5);
                    return dealii::Point<3>(r * std::sin(theta) * std::cos(phi),
                                            r * std::sin(theta) * std::sin(phi),
                                            r * std::cos(theta));
                  });
  }

  struct Curved
  {
    unsigned int q;
    Element      element;
  };

  inline void
  PrintTo(const Curved &c, std::ostream *stream)
  {
    corotet::PrintTo(c.element, stream);
    *stream << " with maps of degree " << c.q;
  }

  inline const std::vector<Curved> curved_elements{
    {2, 2},
    {3, 3},
    {2, 3},
    {3, 2},
    {2, Element::quadratic_with_bubbles()}};
} // namespace corotet::tests

#endif
