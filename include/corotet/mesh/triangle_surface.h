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
  /// Triangles as the file of a scanner or a CAD program has them: the surface
  /// of one or several bodies, and of what is hollow in them.
  struct TriangleSurface
  {
    using Triangle = std::array<unsigned int, 3>;

    std::vector<dealii::Point<3>> vertices;
    std::vector<Triangle>         triangles;
    /// Which of @p names each triangle has.
    std::vector<unsigned int> groups;
    /// What the file calls the triangles of each group: no, one or several
    /// names.
    std::vector<std::vector<std::string>> names;

    /// The file, and what the user should know about how it was mended.
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
   * Mends what can be mended without changing the shape, each with a remark:
   * vertices at one place become one (within what numbers of seven digits tell
   * apart), triangles that have become lines and further copies of a triangle
   * go, a triangle whose corners lie on a line goes by turning the edge that
   * it shares with its neighbour, and triangles are turned over so that all of
   * a closed surface face the same way.
   *
   * Throws an InputError with their number and the first place if edges have
   * one triangle (a hole) or more than two, if a surface has one side only, or
   * if triangles cross or touch each other.
   */
  void
  mend_surface(TriangleSurface &surface);

  /// Throws an InputError if triangles of a mended surface cross or touch each
  /// other elsewhere than in shared vertices and edges.
  void
  check_intersections(const TriangleSurface &surface);

  /// The edge of two triangles between the vertices @p from and @p to; edge i
  /// of a triangle is that from its corner i to the next one.
  struct SurfaceEdge
  {
    unsigned int                from, to;
    std::array<unsigned int, 2> triangles;
  };

  /// All edges of a mended surface.
  std::vector<SurfaceEdge>
  surface_edges(const TriangleSurface &surface);

  /// A body: its outer closed surface, and those of the hollows in it, by their
  /// numbers.
  struct SurfaceBody
  {
    std::vector<unsigned int> shells;
  };

  /// Which triangles are connected, and what they are the surface of.
  struct SurfaceShells
  {
    /// Of each triangle, the number of the closed surface that it belongs to.
    std::vector<unsigned int> of_triangle;
    std::vector<SurfaceBody>  bodies;
  };

  /// The closed surfaces that a mended surface consists of. One that is inside
  /// of another is a hollow, and one inside of a hollow is a body again.
  SurfaceShells
  surface_shells(const TriangleSurface          &surface,
                 const std::vector<SurfaceEdge> &edges);

  /**
   * Of each triangle the patch that it belongs to, from 0 in the order of the
   * triangles: patches end at edges where neighbours' normals differ by more
   * than @p feature_angle [degree], and where their groups differ.
   */
  std::vector<unsigned int>
  surface_patches(const TriangleSurface          &surface,
                  const std::vector<SurfaceEdge> &edges,
                  const double                    feature_angle);
} // namespace corotet

#endif
