// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_triangle_surface_h
#define corotet_mesh_triangle_surface_h

#include <corotet/mesh/mesh_format.h>

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace corotet
{
  /// The triangles in a file of a scanner or a CAD program: the surface of one
  /// or several bodies, and of the hollows in them.
  struct TriangleSurface
  {
    using Triangle = std::array<unsigned int, 3>;

    std::vector<dealii::Point<3>> vertices;
    std::vector<Triangle>         triangles;
    /// The index in @p names of each triangle's group.
    std::vector<unsigned int> groups;
    /// The names of each group in the file: none, one or several.
    std::vector<std::vector<std::string>> names;

    /// The file, and remarks for the user about how the surface was mended.
    std::string              origin;
    std::vector<std::string> remarks;
  };

  /**
   * The triangles of a file of the format STL (ASCII or binary), PLY (ASCII or
   * binary), OBJ or OFF; polygons with more corners are cut into triangles.
   * Names are those of solids (STL) or of objects, groups and materials
   * (OBJ). Throws InputError that names file and line.
   */
  TriangleSurface
  read_triangle_file(const std::string &path, const MeshFormat format);

  /**
   * Mends defects without changing the shape, each kind with a remark. Vertices
   * at the same place are united (within the accuracy of numbers of seven
   * digits). Triangles that have become lines, and copies of triangles, are
   * removed. A triangle whose corners lie on a line is removed by turning the
   * edge that it shares with its neighbour. Triangles are turned over so that
   * all of a closed surface face the same way.
   *
   * Throws an InputError, with the number of places and the first of them, if
   * edges have one triangle (a hole) or more than two, if a surface has one
   * side only, or if triangles cross or touch each other.
   */
  void
  mend_surface(TriangleSurface &surface);

  /// Throws an InputError if triangles of a mended surface cross or touch each
  /// other elsewhere than in shared vertices and edges.
  void
  check_intersections(const TriangleSurface &surface);

  /// The common edge of two triangles, from vertex @p from to vertex @p to;
  /// edge i of a triangle goes from its corner i to the next one.
  struct SurfaceEdge
  {
    unsigned int                from, to;
    std::array<unsigned int, 2> triangles;
  };

  /// All edges of a mended surface.
  std::vector<SurfaceEdge>
  surface_edges(const TriangleSurface &surface);

  /// A body: the numbers of its outer closed surface, and of those of the
  /// hollows in it.
  struct SurfaceBody
  {
    std::vector<unsigned int> shells;
  };

  /// The closed surfaces of connected triangles, and the bodies that they
  /// enclose.
  struct SurfaceShells
  {
    /// The number of the closed surface that each triangle belongs to.
    std::vector<unsigned int> of_triangle;
    std::vector<SurfaceBody>  bodies;
  };

  /// Finds the closed surfaces of a mended surface. A surface inside of another
  /// one is a hollow, and one inside of a hollow is a body again.
  SurfaceShells
  surface_shells(const TriangleSurface          &surface,
                 const std::vector<SurfaceEdge> &edges);

  /**
   * The patch that each triangle belongs to, numbered from 0 in the order of
   * the triangles: patches end at edges where neighbours' normals differ by
   * more than @p feature_angle [degree], and where their groups differ.
   */
  std::vector<unsigned int>
  surface_patches(const TriangleSurface          &surface,
                  const std::vector<SurfaceEdge> &edges,
                  const double                    feature_angle);
} // namespace corotet

#endif
