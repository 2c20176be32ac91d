// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_abaqus_reader_h
#define corotet_source_mesh_abaqus_reader_h

#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "abaqus_lines.h"
#include "abaqus_model.h"

namespace corotet::abaqus
{
  /// A part, which instances are copies of.
  struct Part
  {
    Place place;
    Model model;
    Scope scope;
  };

  /// A copy of a part in the assembly.
  struct Instance
  {
    Place       place;
    std::string name;
    const Part *part = nullptr;
    /// A shift, and a rotation: two points of the axis and the angle [degree].
    std::vector<std::vector<double>> motion;
    bool                             is_placed = false;
  };

  /// Reads a file into a Model, one keyword after another.
  class Reader
  {
  public:
    /// Reads the file. Throws InputError and MachineError.
    explicit Reader(const std::string &path);

    ImportedMesh
    mesh() const;

  private:
    Model &
    current_model();

    Scope &
    current_scope();

    void
    read(const std::string &file, const unsigned int depth);

    void
    begin_keyword(const Keyword &next, const unsigned int depth);

    void
    add_data(const std::string &line, const Place &place);

    void
    finish_keyword();

    // Reads the file that a line at @p place includes. @p place is a copy, as
    // it may be that of the keyword, which changes.
    void
    read_other(const std::string &name,
               const Place        place,
               const unsigned int depth);

    void
    check_coordinates() const;

    void
    add_node(const std::vector<std::string> &words, const Place &place);

    void
    begin_elements();

    void
    add_element(const std::string &line, const Place &place);

    static std::uint32_t
    node_of(const std::int64_t number, const Scope &scope, const Place &place);

    // The scope in which the members of a set are looked up, such as an
    // instance.
    const Scope &
    scope_of_members(const Place &place);

    std::vector<std::uint32_t> &
    target_of_set();

    // Begins a set. A set of nodes may consist of the nodes of a set of
    // elements.
    void
    begin_set();

    // The members that a word of a data line means, by a number or as a set.
    std::vector<std::uint32_t>
    members_of(const std::string &word, const Place &place);

    void
    add_to_set(const std::vector<std::string> &words, const Place &place);

    void
    begin_surface();

    void
    add_to_surface(const std::vector<std::string> &words, const Place &place);

    // The scope and name of a word; "instance.set" belongs to the instance.
    std::pair<const Scope *, std::string>
    scope_and_name(const std::string &word, const Place &place);

    // Counts members of copies against n_left: copies of sets and parts can be
    // many times longer than the file.
    void
    spend(const std::size_t n, const Place &place);

    void
    begin_part();

    void
    end_part();

    void
    begin_instance();

    // Adds a line of an instance: the shift is in the first line, the rotation
    // in the second one.
    void
    add_motion(const std::vector<std::string> &words, const Place &place);

    // Adds the copy of the part, after its motion has been read.
    void
    place_instance();

    void
    end_instance();

    const std::filesystem::path folder;
    const std::string           path;

    Keyword keyword;
    /// The kind of the elements that are being read, and the words so far of an
    /// element that continues in the next line.
    Kind                      kind;
    std::vector<std::int64_t> unfinished;
    bool                      goes_on    = false;
    unsigned int              n_included = 0;

    /// The number of members that copies of sets and of parts may still have.
    std::size_t n_left = 20'000'000;

    std::map<std::string, Part> parts;
    Part                       *part = nullptr;
    std::optional<Instance>     instance;
    Model                       model;
    /// The scopes: first that of the file, then those of the instances.
    std::vector<Scope>    scopes;
    std::set<std::string> ignored;
    /// Remarks for the user.
    std::vector<std::string> remarks;
  };
} // namespace corotet::abaqus

#endif
