// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_selection_h
#define corotet_source_mesh_selection_h

#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/point.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace corotet::selections
{
  /// What can be selected: faces of the surface, or cells.
  struct Members
  {
    /// What a message calls one: "face".
    std::string kind;
    /// The points that must be inside of a shape, of each member.
    std::vector<std::vector<dealii::Point<3>>> points;
    /// Outer unit normals of faces; empty for others.
    std::vector<dealii::Tensor<1, 3>> normals;
    /// Of faces, those that share an edge; empty for others.
    std::vector<std::vector<unsigned int>> neighbours;
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

  /// Whether a word begins a shape.
  bool
  is_shape(const std::string &word);
} // namespace corotet::selections

#endif
