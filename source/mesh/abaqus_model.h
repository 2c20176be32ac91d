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
  /// The use of an element in corotet.
  enum class Shape : unsigned char
  {
    tetrahedron,
    /// Its set gives a name to a face.
    triangle,
    /// Its set gives a name to nodes.
    line,
    /// Cannot be computed.
    other
  };

  struct Kind
  {
    Shape        shape   = Shape::other;
    unsigned int n_nodes = 0;
  };

  /// The shape and number of nodes of an element type such as "C3D10M", in
  /// capitals.
  Kind
  kind_of(const std::string &type);

  struct Element
  {
    Kind kind;
    /// The position of its first node in Model::element_nodes.
    std::size_t first = 0;
  };

  /// A face of an element, "set or element, S2".
  struct FaceOfElement
  {
    std::uint32_t element;
    /// Abaqus' number of the face, 1 to 4; 0 stands for the faces on the
    /// surface of the body.
    unsigned char number;
  };

  /// Sets by their names in capitals, with the spelling of the first
  /// occurrence.
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

  /// The numbers and names of a part, of an instance or of the whole model,
  /// with the indices of nodes and elements in the Model.
  struct Scope
  {
    std::string                                     name;
    std::unordered_map<std::int64_t, std::uint32_t> nodes;
    std::unordered_map<std::int64_t, std::uint32_t> elements;
    Named<std::vector<std::uint32_t>>               node_sets;
    Named<std::vector<std::uint32_t>>               element_sets;
    Named<std::vector<FaceOfElement>>               surfaces;
    /// Names, in capitals, of sets that a program has made for surfaces.
    std::set<std::string> internal_node_sets;
    std::set<std::string> internal_element_sets;
  };

  struct Model
  {
    std::vector<dealii::Point<3>> nodes;
    std::vector<Element>          elements;
    std::vector<std::uint32_t>    element_nodes;
    /// The number of elements of each type that cannot be computed.
    std::map<std::string, std::size_t> others;

    /// Throws InputError if there are elements that cannot be computed.
    void
    check_other_cells(const std::string &path) const;

    /// Adds a copy of @p part with its nodes at @p places, and returns the
    /// scope of the copy.
    Scope
    add_copy(const Model                         &part,
             const Scope                         &scope,
             const std::vector<dealii::Point<3>> &places);

    /// The nodes of all tetrahedra with ten nodes.
    std::vector<std::uint32_t>
    quadratic_tetrahedra() const;
  };

  /// The tetrahedra of a model and the sets of all its scopes. Throws
  /// InputError if there are no tetrahedra, several kinds of them or other
  /// cells.
  ImportedMesh
  imported_mesh(const Model              &model,
                const std::vector<Scope> &scopes,
                const std::string        &path);
} // namespace corotet::abaqus

#endif
