// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_names_h
#define corotet_mesh_mesh_names_h

#include <deal.II/base/types.h>

#include <compare>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The boundary id of faces of the surface that belong to no boundary. No mesh
   * source uses it and no name selects it.
   */
  constexpr dealii::types::boundary_id unnamed_boundary =
    dealii::numbers::internal_face_boundary_id - 1;

  /**
   * The names of a mesh's regions or boundaries. Each cell has one region and
   * each face of the surface one boundary, which are identified by ids. A name
   * means one id, or several, so named sets may overlap. Edges and corners are
   * named in the same way.
   */
  struct NamedSets
  {
    /// The name of each id. An id that is not listed, or has an empty name, has
    /// no name of its own.
    std::map<unsigned int, std::string> names;
    /// The names that mean several ids (ascending), or one id that other names
    /// also mean.
    std::map<std::string, std::vector<unsigned int>> sets;
    /// For an id in @p names that has been split, all ids that its members have
    /// now (ascending): the meaning of its number.
    std::map<unsigned int, std::vector<unsigned int>> parts = {};

    /// The ids that @p name means; none if nothing has this name.
    std::vector<unsigned int>
    ids(const std::string &name) const;

    /**
     * Makes @p name mean the members with the indices @p members in @p
     * id_of_member, which has pointers to the ids of all cells or faces. An id
     * that other members also have is split. All names and numbers keep their
     * meaning. If @p name exists already, the members are added to it. Members
     * that are listed more than once count once.
     */
    void
    add(const std::string                 &name,
        std::vector<std::size_t>           members,
        const std::vector<unsigned int *> &id_of_member);

    /// The number of members with an id, and how many of these are in a set.
    struct IdCount
    {
      unsigned int  id;
      std::uint64_t n_members, n_in_set;
    };

    /// Like add() above, for members that were counted: @p counts has the ids
    /// in the set, ascending; @p first_free is above the ids of all members.
    /// Returns the new id of the members in the set for each id that is split.
    std::map<unsigned int, unsigned int>
    add(const std::string          &name,
        const std::vector<IdCount> &counts,
        const unsigned int          first_free);

    /// Removes ids that are not in @p used, and sets that become empty; used
    /// ids without a name get their number as name.
    void
    restrict_to(const std::vector<unsigned int> &used);
  };

  /**
   * Ids by name, and names by id, of the regions, the boundaries, the edges or
   * the corners of a mesh.
   */
  class MeshNames
  {
  public:
    /// @p kind is "region", "boundary", "edge" or "corner"; @p named has every
    /// id of the mesh (an id with an empty name is known by its number).
    MeshNames(const std::string &kind, const NamedSets &named);

    /**
     * The ids that @p name_or_id means, ascending. Throws InputError blamed on
     * the parameter @p entry ("Section/Entry"), with the existing names and the
     * nearest one.
     */
    std::vector<unsigned int>
    ids(const std::string &name_or_id, const std::string &entry) const;

    /// The ids that a name means, or the id with this number; none if there is
    /// neither.
    std::vector<unsigned int>
    find(const std::string &name_or_id) const;

    /// The ids that a name means, without numbers.
    std::vector<unsigned int>
    find_name(const std::string &name) const
    {
      return named.ids(name);
    }

    /// The text "the boundaries: a, b, c", or "no boundaries".
    std::string
    listed() const;

    /// Throws the InputError about a name that none of @p all has.
    [[noreturn]] static void
    refuse(const std::string                    &name_or_id,
           const std::string                    &entry,
           const std::vector<const MeshNames *> &all);

    /// The name of @p id; "a & b" for an id that several names have in common;
    /// or the id itself as text if no name has it.
    std::string
    name(const unsigned int id) const;

    /// The name of ids that ids() has returned.
    std::string
    name(const std::vector<unsigned int> &ids) const;

    /// All names, and the numbers of ids without a name: the valid arguments of
    /// ids().
    std::vector<std::string>
    known() const;

    /// All known() with their ids, in less time than by calling ids() for each.
    std::vector<std::pair<std::string, std::vector<unsigned int>>>
    known_with_ids() const;

    /// All ids, with their own names.
    const std::map<unsigned int, std::string> &
    all() const
    {
      return named.names;
    }

  private:
    /// The ids that the number @p id means.
    std::vector<unsigned int>
    of_number(const unsigned int id) const;

    std::string kind;
    NamedSets   named;
  };

  /**
   * The meaning of one name: ids of boundaries, of edges and of corners, each
   * ascending. A name may mean some of each kind.
   */
  struct Place
  {
    std::vector<unsigned int> boundaries;
    std::vector<unsigned int> edges;
    std::vector<unsigned int> corners;

    auto
    operator<=>(const Place &) const = default;
  };

  /**
   * The names of places where a body can be held: boundaries, edges and
   * corners.
   */
  struct PlaceNames
  {
    explicit PlaceNames(const NamedSets &boundaries,
                        const NamedSets &edges   = {},
                        const NamedSets &corners = {});

    MeshNames boundaries;
    MeshNames edges;
    MeshNames corners;

    /// All places with this name; otherwise the place with this number, a
    /// boundary rather than an edge, and an edge rather than a corner. Throws
    /// InputError that blames the parameter @p entry.
    Place
    find(const std::string &name_or_id, const std::string &entry) const;

    /// The ids of boundaries only, for a condition @p what that acts on an area
    /// ("a traction"). Throws an InputError that says so for names of edges and
    /// corners.
    std::vector<unsigned int>
    boundary_ids(const std::string &name_or_id,
                 const std::string &entry,
                 const std::string &what) const;

    std::string
    name(const Place &place) const;

    /// The word "boundary", "edge" or "corner"; "place" if it is of several
    /// kinds.
    static std::string
    kind(const Place &place);
  };
} // namespace corotet

#endif
