// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_abaqus_model_h
#define corotet_source_mesh_abaqus_model_h

#include <corotet/mesh/imported_mesh.h>

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

namespace corotet::abaqus
{
  /// What an element is to corotet.
  enum class Shape : unsigned char
  {
    tetrahedron,
    /// Gives its set's name to a face.
    triangle,
    /// Gives its set's name to nodes.
    line,
    /// Cannot be computed.
    other
  };

  struct Kind
  {
    Shape        shape   = Shape::other;
    unsigned int n_nodes = 0;
  };

  /// Of an element type, "C3D10M", in capitals.
  Kind
  kind_of(const std::string &type);

  struct Element
  {
    Kind kind;
    /// Where its nodes begin in Model::element_nodes.
    std::size_t first = 0;
  };

  /// Faces of elements, "set or element, S2".
  struct FaceOfElement
  {
    std::uint32_t element;
    /// Abaqus' number, 1 to 4; 0: those on the surface of the body.
    unsigned char number;
  };

  /// Names by their capitals, with the spelling of the first occurrence.
  template <typename Set>
  struct Named
  {
    std::map<std::string, Set>         sets;
    std::map<std::string, std::string> spelling;

    Set &
    operator[](const std::string &name);
    const Set *
    find(const std::string &name) const;
  };

  /// Numbers and names of a part, of an instance or of the whole model: nodes
  /// and elements by their places in the Model.
  struct Scope
  {
    std::string                                     name;
    std::unordered_map<std::int64_t, std::uint32_t> nodes;
    std::unordered_map<std::int64_t, std::uint32_t> elements;
    Named<std::vector<std::uint32_t>>               node_sets;
    Named<std::vector<std::uint32_t>>               element_sets;
    Named<std::vector<FaceOfElement>>               surfaces;
    /// Names of sets that a program has made for surfaces; in capitals.
    std::set<std::string> internal_node_sets;
    std::set<std::string> internal_element_sets;
  };

  struct Model
  {
    std::vector<dealii::Point<3>> nodes;
    std::vector<Element>          elements;
    std::vector<std::uint32_t>    element_nodes;
    /// How many elements of each type cannot be computed.
    std::map<std::string, std::size_t> others;

    /// Throws InputError if there are elements that cannot be computed.
    void
    check_other_cells(const std::string &path) const;

    /// Adds a copy of @p part with its nodes at other places, and returns the
    /// scope of the copy.
    Scope
    add_copy(const Model                         &part,
             const Scope                         &scope,
             const std::vector<dealii::Point<3>> &places);

    /// Nodes of the tetrahedra with ten nodes.
    std::vector<std::uint32_t>
    quadratic_tetrahedra() const;
  };

  /// The tetrahedra of a model and the sets of all its scopes. Throws
  /// InputError if there are none, several kinds of them or other cells.
  ImportedMesh
  imported_mesh(const Model              &model,
                const std::vector<Scope> &scopes,
                const std::string        &path);
} // namespace corotet::abaqus

#endif
