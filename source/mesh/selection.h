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
   * What can be selected: faces of the surface, cells, edges or corners. A rank
   * has those of its own cells, and faces of the cells beside them as well:
   * several ranks have a member, and find the same of it.
   */
  struct Members
  {
    /// What a message calls one: "face", "cell", "edge" or "corner".
    std::string kind;
    MPI_Comm    communicator = MPI_COMM_NULL;
    /// Of each member, the points that must be inside of a shape.
    unsigned int                  n_points = 1;
    std::vector<dealii::Point<3>> points;
    /// Whether it is this rank that counts a member.
    std::vector<bool> is_counted;
    /// Outer unit normals, if members are faces.
    bool                              has_normals = false;
    std::vector<dealii::Tensor<1, 3>> normals;
    /// Of faces, those that share an edge.
    std::vector<std::vector<unsigned int>> neighbours;
    /// Of faces, what all ranks know them by. Those that the mesh has listed
    /// come first.
    std::vector<std::uint64_t> keys;
    /// Gives faces that other ranks count the value that these have.
    /// Collective.
    std::function<void(std::vector<unsigned char> &values)> update;
    /// Of edges and corners, which are where a face with a normal or of a patch
    /// is: faces of the surface, and those that each member belongs to. @p
    /// surface must outlive this object.
    const Members                         *surface = nullptr;
    std::vector<std::vector<unsigned int>> faces;
    /// The angle between the normals of the faces there [degree], if members
    /// are edges.
    bool                has_angles = false;
    std::vector<double> angles;
    /// Distances that are nothing [m].
    double tolerance = 0;
    /// Whether each member has a name that the mesh has; throws InputError if
    /// there is none. Collective.
    std::function<std::vector<bool>(const std::string &name)> with_name;

    std::size_t
    size() const
    {
      return points.size() / n_points;
    }
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
    /// What the log says of it, beside the number of members; or empty.
    std::string remark = {};
  };

  /// A selection, and the shapes that it consists of.
  struct Selected
  {
    std::vector<bool>  is_member;
    std::vector<Shape> shapes;
  };

  /// The members that a text selects. Throws InputError that blames @p entry if
  /// it is no selection. Collective, as are all of these functions.
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

  /// Faces of the surface: those of a rank's own cells, and those of the cells
  /// beside them that have a vertex of an own cell.
  struct Surface
  {
    /// Each with its boundary.
    std::vector<CellPart> faces;
    Members               members;
  };

  /// That of a mesh, with the id @p unnamed for faces that are not listed.
  Surface
  surface_of(const LocalMesh   &mesh,
             const GhostCells  &ghosts,
             const unsigned int unnamed);

  /// The local vertices of a face.
  std::array<unsigned int, 3>
  vertices_of(const LocalMesh &mesh, const CellPart &face);

  /// Whether each local vertex is one of an own cell, so that all cells that
  /// have it are there.
  std::vector<bool>
  vertices_of_own_cells(const LocalMesh &mesh);

  /// An id that no part of a kind has in the mesh, and no name means: it and
  /// all above it are new.
  unsigned int
  id_without_name(const NamedSets &named);

  /// Distances that are nothing in a mesh [m].
  double
  tolerance(const LocalMesh &mesh);

  /// Whether something of the surface has this name or number.
  bool
  is_place(const UsedNames &names, const std::string &name);

  /// The ids that members of all ranks have, ascending, where those of this
  /// rank have these.
  std::vector<unsigned int>
  ids_of_all(std::vector<unsigned int> own, const MPI_Comm comm);

  /// Name edges of the surface, and vertices. Errors as in corotet::select().
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
