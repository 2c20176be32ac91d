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
    /// A shift, and a turn: two points of the axis and the angle in degrees.
    std::vector<std::vector<double>> motion;
    bool                             is_placed = false;
  };

  /// Reads a file, keyword by keyword, into a Model.
  class Reader
  {
  public:
    /// Reads it. Throws InputError and MachineError.
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

    // What a line at @p place includes: a copy, as it may be the keyword's.
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

    // Where the members of a set are looked up: in an instance, say.
    const Scope &
    scope_of_members(const Place &place);

    std::vector<std::uint32_t> &
    target_of_set();

    // A set of nodes may be that of the nodes of a set of elements.
    void
    begin_set();

    // What a word of a line of data means, by its number or as a set.
    std::vector<std::uint32_t>
    members_of(const std::string &word, const Place &place);

    void
    add_to_set(const std::vector<std::string> &words, const Place &place);

    void
    begin_surface();

    void
    add_to_surface(const std::vector<std::string> &words, const Place &place);

    // "instance.set" is looked up in the instance.
    std::pair<const Scope *, std::string>
    scope_and_name(const std::string &word, const Place &place);

    // Copies of sets and parts can be many times longer than the file.
    void
    spend(const std::size_t n, const Place &place);

    void
    begin_part();

    void
    end_part();

    void
    begin_instance();

    // The shift in the first line, and the turn in the second one.
    void
    add_motion(const std::vector<std::string> &words, const Place &place);

    // Adds the copy of the part, when its motion has been read.
    void
    place_instance();

    void
    end_instance();

    const std::filesystem::path folder;
    const std::string           path;

    Keyword keyword;
    /// Of the elements that are read; what there is so far of one that goes on
    /// in the next line.
    Kind                      kind;
    std::vector<std::int64_t> unfinished;
    bool                      goes_on    = false;
    unsigned int              n_included = 0;

    /// How many members copies of sets and of parts may still have.
    std::size_t n_left = 20'000'000;

    std::map<std::string, Part> parts;
    Part                       *part = nullptr;
    std::optional<Instance>     instance;
    Model                       model;
    /// The first one is that of the file, then those of the instances.
    std::vector<Scope>    scopes;
    std::set<std::string> ignored;
    /// What the user should know.
    std::vector<std::string> remarks;
  };
} // namespace corotet::abaqus

#endif
