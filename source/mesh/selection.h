// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_selection_h
#define corotet_source_mesh_selection_h

#include <corotet/base/log.h>
#include <corotet/mesh/ghost_cells.h>
#include <corotet/mesh/local_mesh.h>
#include <corotet/mesh/used_names.h>

#include <deal.II/base/point.h>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace corotet::selections
{
  /**
   * The candidates of a selection: faces of the surface, cells, edges or
   * corners. A rank has those of its own cells, and also faces of the cells
   * beside them: several ranks may have the same member, and get the same
   * result for it.
   */
  struct Members
  {
    /// The word for a member in messages: "face", "cell", "edge" or "corner".
    std::string kind;
    MPI_Comm    communicator = MPI_COMM_NULL;
    /// The points of each member, which must all be inside of a shape.
    unsigned int                  n_points = 1;
    std::vector<dealii::Point<3>> points;
    /// Whether this rank counts the member.
    std::vector<bool> is_counted;
    /// The outer unit normals, if members are faces.
    bool                              has_normals = false;
    std::vector<dealii::Tensor<1, 3>> normals;
    /// For faces, the faces that share an edge with each of them.
    std::vector<std::vector<unsigned int>> neighbours;
    /// For faces, the numbers by which all ranks know them. Faces that the mesh
    /// has listed come first.
    std::vector<std::uint64_t> keys;
    /// For faces, sets the values of those that other ranks count to the values
    /// there. Collective.
    std::function<void(std::vector<unsigned char> &values)> update;
    /// For edges and corners, the faces of the surface, and those that each
    /// member belongs to: a member has the normals and patches of its faces. @p
    /// surface must outlive this object.
    const Members                         *surface = nullptr;
    std::vector<std::vector<unsigned int>> faces;
    /// For edges, the angle between the normals of the faces there [degree].
    bool                has_angles = false;
    std::vector<double> angles;
    /// The distance below which points count as equal [m].
    double tolerance = 0;
    /// Whether each member has a name of the mesh; throws InputError if there
    /// is no such name. Collective.
    std::function<std::vector<bool>(const std::string &name)> with_name;

    std::size_t
    size() const
    {
      return points.size() / n_points;
    }
  };

  /// A shape, and the distances of members from it.
  struct Shape
  {
    /// The text of the shape, as written by the user.
    std::string text;
    /// The unit of the distances: "m" or "degrees"; empty if there are none.
    std::string unit;
    /// The distance of each member: at most 0 if it is inside.
    std::vector<double> distances;
    /// A remark for the log, beside the number of members; may be empty.
    std::string remark = {};
  };

  /// A selection, and the shapes that it consists of.
  struct Selected
  {
    std::vector<bool>  is_member;
    std::vector<Shape> shapes;
  };

  /// The members that a text selects. Throws InputError that blames @p entry if
  /// the text is not a selection. Collective, as are all of these functions.
  Selected
  select(const std::string &text,
         const Members     &members,
         const std::string &entry);

  /// The distance of each member from the shape that @p words describe by a
  /// keyword and numbers. Throws InputError.
  Shape
  measure(const std::vector<std::string> &words,
          const Members                  &members,
          const std::string              &entry);

  /// Whether a word begins a shape that is possible for these members.
  bool
  is_shape(const std::string &word, const Members &members);

  /// The angle between two directions [degree].
  double
  degrees_between(const dealii::Tensor<1, 3> &a, const dealii::Tensor<1, 3> &b);

  /// Selects by a list "name: selection, name: selection" and logs how much
  /// each selection is. Before it reads the next selection, it calls @p
  /// give_name with the indices of the members. Throws InputError that blames
  /// @p entry if a text is wrong, nothing is selected, or a name is taken
  /// according to @p is_taken.
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

  /// The faces of the surface on a rank: those of its own cells, and those of
  /// the cells beside them that have a vertex of an own cell.
  struct Surface
  {
    /// Each face with its boundary.
    std::vector<CellPart> faces;
    Members               members;
  };

  /// The surface of a mesh, with the id @p unnamed for faces that are not
  /// listed.
  Surface
  surface_of(const LocalMesh   &mesh,
             const GhostCells  &ghosts,
             const unsigned int unnamed);

  /// The local vertices of a face.
  std::array<unsigned int, 3>
  vertices_of(const LocalMesh &mesh, const CellPart &face);

  /// Whether each local vertex belongs to an own cell, so that all cells around
  /// it are known.
  std::vector<bool>
  vertices_of_own_cells(const LocalMesh &mesh);

  /// An id that no part of a kind has in the mesh, and no name means; all ids
  /// above it are also unused.
  unsigned int
  id_without_name(const NamedSets &named);

  /// The distance below which points of a mesh count as equal [m].
  double
  tolerance(const LocalMesh &mesh);

  /// Whether a part of the surface has this name or number.
  bool
  is_place(const UsedNames &names, const std::string &name);

  /// The ids of members on all ranks, ascending; @p own are those on this rank.
  std::vector<unsigned int>
  ids_of_all(std::vector<unsigned int> own, const MPI_Comm comm);

  /// Give names to edges of the surface, and to vertices. Errors as in
  /// corotet::select().
  void
  select_edges(LocalMesh         &mesh,
               UsedNames         &names,
               const GhostCells  &ghosts,
               const std::string &text,
               Log               &log);
  void
  select_corners(LocalMesh         &mesh,
                 UsedNames         &names,
                 const GhostCells  &ghosts,
                 const std::string &text,
                 Log               &log);
} // namespace corotet::selections

#endif
