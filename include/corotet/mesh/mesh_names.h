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
   * What a mesh calls its regions or its boundaries. Each cell has one region
   * and each face of the surface one boundary, which are known by ids. A name
   * means one id, or several: so sets may overlap. Edges and corners are named
   * in the same way.
   */
  struct NamedSets
  {
    /// By id; ids that are not here, or have an empty name, have no name of
    /// their own.
    std::map<unsigned int, std::string> names;
    /// Names that mean several ids (ascending), or one that has others, too.
    std::map<std::string, std::vector<unsigned int>> sets;
    /// What the number of an id in @p names that has been split means: all ids
    /// that its members have now (ascending).
    std::map<unsigned int, std::vector<unsigned int>> parts;

    /// The ids that @p name means; none if nothing has this name.
    std::vector<unsigned int>
    ids(const std::string &name) const;

    /**
     * Makes @p name mean the members whose places in @p id_of_member, which has
     * the ids of all cells or faces, are @p members: an id that others have,
     * too, is split. What names and numbers meant before they mean still. A
     * name that there is gets the members in addition.
     */
    void
    add(const std::string                 &name,
        const std::vector<std::size_t>    &members,
        const std::vector<unsigned int *> &id_of_member);

    /// How many members have an id, and how many of them are in a set.
    struct IdCount
    {
      unsigned int  id;
      std::uint64_t n_members, n_in_set;
    };

    /// The same of members that are counted: @p counts has the ids of the set,
    /// ascending, @p first_free is above the ids of all members. Returns, by
    /// their ids, the new ones of members of the set whose ids are split.
    std::map<unsigned int, unsigned int>
    add(const std::string          &name,
        const std::vector<IdCount> &counts,
        const unsigned int          first_free);

    /// Forgets ids that are not in @p used, and sets that are empty then;
    /// used ids without a name are known by their number.
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
    /// @p kind is "region", "boundary", "edge" or "corner"; @p named holds
    /// every id that the mesh has (an empty name: known by its id).
    MeshNames(const std::string &kind, const NamedSets &named);

    /**
     * The ids that @p name_or_id means, ascending. Throws InputError blamed on
     * the parameter @p entry ("Section/Entry"), with the names that there are
     * and the nearest one.
     */
    std::vector<unsigned int>
    ids(const std::string &name_or_id, const std::string &entry) const;

    /// Those that a name means, or the one with this number; none if there is
    /// no such thing.
    std::vector<unsigned int>
    find(const std::string &name_or_id) const;

    /// Only those that a name means.
    std::vector<unsigned int>
    find_name(const std::string &name) const
    {
      return named.ids(name);
    }

    /// "the boundaries: a, b, c", or "no boundaries".
    std::string
    listed() const;

    /// Throws the InputError about a name that none of @p all knows.
    [[noreturn]] static void
    refuse(const std::string                    &name_or_id,
           const std::string                    &entry,
           const std::vector<const MeshNames *> &all);

    /// The name of @p id; "a & b" for what several have in common; or the id
    /// itself as text if it is in none.
    std::string
    name(const unsigned int id) const;

    /// Of what ids() has given.
    std::string
    name(const std::vector<unsigned int> &ids) const;

    /// All names, and ids without one: what ids() takes.
    std::vector<std::string>
    known() const;

    /// The same, with the ids that they mean: many of them take no longer for
    /// each.
    std::vector<std::pair<std::string, std::vector<unsigned int>>>
    known_with_ids() const;

    /// All ids, with their own names.
    const std::map<unsigned int, std::string> &
    all() const
    {
      return named.names;
    }

  private:
    /// What the number @p id means.
    std::vector<unsigned int>
    of_number(const unsigned int id) const;

    std::string kind;
    NamedSets   named;
  };

  /**
   * What one name means: ids of boundaries, of edges and of corners, each
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
   * Names of what a body can be held at: its boundaries, edges and corners.
   */
  struct PlaceNames
  {
    explicit PlaceNames(const NamedSets &boundaries,
                        const NamedSets &edges   = {},
                        const NamedSets &corners = {});

    MeshNames boundaries;
    MeshNames edges;
    MeshNames corners;

    /// All that has this name; else what has this number, a boundary rather
    /// than an edge, and an edge rather than a corner. Throws InputError that
    /// blames the parameter @p entry.
    Place
    find(const std::string &name_or_id, const std::string &entry) const;

    /// Boundaries only, for what acts on an area, as @p what does ("a
    /// traction"): an InputError says so of names of edges and corners.
    std::vector<unsigned int>
    boundary_ids(const std::string &name_or_id,
                 const std::string &entry,
                 const std::string &what) const;

    std::string
    name(const Place &place) const;

    /// "boundary", "edge" or "corner"; "place" if it is of several kinds.
    static std::string
    kind(const Place &place);
  };
} // namespace corotet

#endif
