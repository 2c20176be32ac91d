// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_selection_h
#define corotet_source_mesh_selection_h

#include <corotet/base/log.h>
#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/point.h>

#include <functional>
#include <string>
#include <vector>

namespace corotet::selections
{
  /// What can be selected: faces of the surface, cells, edges or corners.
  struct Members
  {
    /// What a message calls one: "face", "cell", "edge" or "corner".
    std::string kind;
    /// The points that must be inside of a shape, of each member.
    std::vector<std::vector<dealii::Point<3>>> points;
    /// Outer unit normals of faces; empty for others.
    std::vector<dealii::Tensor<1, 3>> normals;
    /// Of faces, those that share an edge; empty for others.
    std::vector<std::vector<unsigned int>> neighbours;
    /// Of edges and corners, which are where a face with a normal or of a patch
    /// is: all faces of the surface, and those that each member belongs to.
    /// @p surface must outlive this object.
    const Members                         *surface = nullptr;
    std::vector<std::vector<unsigned int>> faces;
    /// Of edges, the angle between the normals of the faces there [degree];
    /// empty for others.
    std::vector<double> angles;
    /// Distances that are nothing [m].
    double tolerance = 0;
    /// Whether each member has a name that the mesh has; throws InputError if
    /// there is none.
    std::function<std::vector<bool>(const std::string &name)> with_name;
  };

  /// One shape, and how far members are from it.
  struct Shape
  {
    /// As it is written.
    std::string text;
    /// The unit of the distances: "m" or "degrees"; empty if there are none.
    std::string unit;
    /// Of each member: at most 0 if it is inside.
    std::vector<double> distances;
  };

  /// A selection, and the shapes that it consists of.
  struct Selected
  {
    std::vector<bool>  is_member;
    std::vector<Shape> shapes;
  };

  /// The members that a text selects. Throws InputError that blames @p entry if
  /// it is no selection.
  Selected
  select(const std::string &text,
         const Members     &members,
         const std::string &entry);

  /// How far each member is from the shape that @p words are: a keyword and
  /// numbers. Throws InputError.
  Shape
  measure(const std::vector<std::string> &words,
          const Members                  &members,
          const std::string              &entry);

  /// Whether a word begins a shape of these members.
  bool
  is_shape(const std::string &word, const Members &members);

  /// Between two directions.
  double
  degrees_between(const dealii::Tensor<1, 3> &a, const dealii::Tensor<1, 3> &b);

  /// Selects what a list "name: selection, name: selection" says, logs how much
  /// that is, and calls @p give_name, before the next selection is read, with
  /// the places of the members. Throws InputError that blames @p entry if a
  /// text is wrong, nothing is selected, or @p is_taken says so of a name.
  void
  select_by_names(
    const std::string                              &text,
    const std::string                              &entry,
    const Members                                  &members,
    const std::function<bool(const std::string &)> &is_taken,
    const std::function<void(const std::string              &name,
                             const std::vector<std::size_t> &chosen)>
        &give_name,
    Log &log);

  /// All faces of the surface.
  struct Surface
  {
    /// Those that the mesh has listed come first.
    std::vector<SerialMesh::Face> faces;
    /// Points and normals of the faces, and which of them are neighbours.
    Members members;
  };

  /// That of a mesh, with an id that no boundary has for faces that are not
  /// listed.
  Surface
  surface_of(const SerialMesh &mesh, const unsigned int unnamed);

  /// An id that no boundary of the mesh has, and no name means.
  unsigned int
  id_without_name(const SerialMesh &mesh);

  /// Distances that are nothing in a mesh [m].
  double
  tolerance(const SerialMesh &mesh);

  /// Whether something of the surface has this name.
  bool
  is_place(const SerialMesh &mesh, const std::string &name);

  /// Name edges of the surface, and vertices. Errors as in corotet::select().
  void
  select_edges(SerialMesh &mesh, const std::string &text, Log &log);
  void
  select_corners(SerialMesh &mesh, const std::string &text, Log &log);
} // namespace corotet::selections

#endif
