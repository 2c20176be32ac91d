// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "abaqus_model.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

#include "abaqus_lines.h"

namespace corotet::abaqus
{
  namespace
  {
    // The corners of the faces S1 to S4 of a tetrahedron.
    constexpr std::array<std::array<unsigned int, 3>, 4> faces{
      {{{0, 1, 2}}, {{0, 3, 1}}, {{1, 3, 2}}, {{2, 3, 0}}}};



    // Adds tetrahedra, which must be of one kind. Abaqus numbers the nodes on
    // edges as FE_SimplexP(2) does.
    std::vector<std::size_t>
    add_tetrahedra(ImportedMesh &mesh, const Model &model)
    {
      std::map<unsigned int, std::size_t> n_of_kind;
      for (const Element &element : model.elements)
        if (element.kind.shape == Shape::tetrahedron)
          ++n_of_kind[element.kind.n_nodes];
      model.check_other_cells(mesh.origin);
      if (n_of_kind.empty())
        throw InputError("", mesh.origin + ": the mesh has no tetrahedra");
      if (n_of_kind.size() > 1)
        throw InputError("",
                         fmt::format("{}: tetrahedra of several degrees: found "
                                     "{} with 4 nodes and {} with 10; one of "
                                     "these is allowed",
                                     mesh.origin,
                                     n_of_kind[4],
                                     n_of_kind[10]));
      const unsigned int n_nodes = n_of_kind.begin()->first;
      mesh.degree                = n_nodes == 4 ? 1 : 2;
      // The number of each element among the tetrahedra.
      std::vector<std::size_t> numbers(model.elements.size());
      for (std::size_t e = 0; e < model.elements.size(); ++e)
        if (const Element &element = model.elements[e];
            element.kind.shape == Shape::tetrahedron)
          {
            numbers[e]        = mesh.cells.size() / n_nodes;
            const auto *nodes = model.element_nodes.data() + element.first;
            mesh.cells.insert(mesh.cells.end(), nodes, nodes + n_nodes);
          }
      return numbers;
    }



    // Exports the sets of all scopes, with the names that they get in the mesh.
    class Export
    {
    public:
      Export(ImportedMesh             &mesh,
             const Model              &model,
             const std::vector<Scope> &scopes)
        : mesh(mesh)
        , model(model)
        , numbers(add_tetrahedra(mesh, model))
      {
        for (const Scope &scope : scopes)
          {
            count(scope, scope.node_sets);
            count(scope, scope.element_sets);
            count(scope, scope.surfaces);
          }
        for (const Scope &scope : scopes)
          {
            for (const auto &[key, set] : scope.element_sets.sets)
              if (!scope.internal_element_sets.contains(key))
                add_elements(name(scope, scope.element_sets, key), set);
            for (const auto &[key, set] : scope.surfaces.sets)
              add_surface(name(scope, scope.surfaces, key), set);
            for (const auto &[key, set] : scope.node_sets.sets)
              if (!scope.internal_node_sets.contains(key))
                add_nodes(name(scope, scope.node_sets, key), set);
          }
      }

    private:
      // Counts the scopes that have sets of each name. A scope may have several
      // kinds of sets with the same name, and different kinds may become names
      // of the same kind.
      template <typename Set>
      void
      count(const Scope &scope, const Named<Set> &named)
      {
        for (const auto &[key, set] : named.sets)
          scopes_with[key].insert(&scope);
      }

      template <typename Set>
      std::string
      name(const Scope &scope, const Named<Set> &named, const std::string &key)
      {
        const std::string &own = named.spelling.at(key);
        return scope.name.empty() || scopes_with[key].size() == 1 ?
                 own :
                 scope.name + "." + own;
      }

      void
      add_elements(const std::string                &name,
                   const std::vector<std::uint32_t> &set)
      {
        for (const std::uint32_t e : set)
          {
            const Element &element = model.elements[e];
            const auto    *nodes   = model.element_nodes.data() + element.first;
            if (element.kind.shape == Shape::tetrahedron)
              mesh.cell_sets[name].push_back(numbers[e]);
            else if (element.kind.shape == Shape::triangle)
              mesh.face_sets[name].push_back({{nodes[0], nodes[1], nodes[2]}});
            else if (element.kind.shape == Shape::line)
              mesh.node_sets[name].insert(mesh.node_sets[name].end(),
                                          nodes,
                                          nodes + element.kind.n_nodes);
          }
      }

      void
      add_surface(const std::string                &name,
                  const std::vector<FaceOfElement> &set)
      {
        for (const FaceOfElement &face : set)
          {
            const Element &element = model.elements[face.element];
            const auto    *nodes   = model.element_nodes.data() + element.first;
            const auto     add     = [&](const unsigned int number) {
              ImportedMesh::Face corners;
              for (unsigned int k = 0; k < 3; ++k)
                corners[k] = nodes[faces[number][k]];
              mesh.face_sets[name].push_back(corners);
            };
            if (element.kind.shape == Shape::triangle)
              mesh.face_sets[name].push_back({{nodes[0], nodes[1], nodes[2]}});
            else if (element.kind.shape != Shape::tetrahedron)
              continue;
            else if (face.number > 0)
              add(face.number - 1);
            else
              for (unsigned int number = 0; number < 4; ++number)
                if (is_outside(nodes, number))
                  add(number);
          }
      }

      void
      add_nodes(const std::string &name, const std::vector<std::uint32_t> &set)
      {
        auto &nodes = mesh.node_sets[name];
        nodes.insert(nodes.end(), set.begin(), set.end());
      }

      // Whether a face belongs to no other tetrahedron.
      bool
      is_outside(const std::uint32_t *nodes, const unsigned int number)
      {
        const auto key = [](const std::uint32_t *corners,
                            const unsigned int   f) {
          ImportedMesh::Face result;
          for (unsigned int k = 0; k < 3; ++k)
            result[k] = corners[faces[f][k]];
          std::sort(result.begin(), result.end());
          return result;
        };
        if (n_cells_of_face.empty())
          for (const Element &element : model.elements)
            if (element.kind.shape == Shape::tetrahedron)
              for (unsigned int f = 0; f < 4; ++f)
                ++n_cells_of_face[key(
                  model.element_nodes.data() + element.first, f)];
        return n_cells_of_face.at(key(nodes, number)) == 1;
      }

      ImportedMesh                                  &mesh;
      const Model                                   &model;
      const std::vector<std::size_t>                 numbers;
      std::map<std::string, std::set<const Scope *>> scopes_with;
      std::map<ImportedMesh::Face, unsigned int>     n_cells_of_face;
    };
  } // namespace



  Kind
  kind_of(const std::string &type)
  {
    static const std::regex tetrahedron("(C|DC|AC|F)3D(4|10)[A-Z]*"),
      triangle("(S|DS|STRI|CPS|CPE|CPEG|CAX|M3D|SFM3D|R3D|DC2D|AC2D)(3|6|65)"
               "[A-Z]*"),
      line("(T2D|T3D|DC1D|AC1D|R2D)(2|3)[A-Z]*|"
           "(B2|B3|PIPE2|PIPE3)(1|2|3)[A-Z]*");
    // Matching longer texts could fill the stack.
    constexpr std::size_t most = 40;
    std::smatch           found;
    if (type.size() > most)
      return {};
    if (std::regex_match(type, found, tetrahedron))
      return {Shape::tetrahedron, found[2] == "4" ? 4U : 10U};
    if (std::regex_match(type, found, triangle))
      return {Shape::triangle, found[2] == "3" ? 3U : 6U};
    if (std::regex_match(type, found, line))
      {
        // The last digit is the number of nodes or, for beams, the degree of
        // their displacements; cubic beams have nodes at their ends only.
        const bool is_beam = found[4].matched;
        return {Shape::line,
                (is_beam ? found[4] == "2" : found[2] == "3") ? 3U : 2U};
      }
    return {};
  }



  template <typename Set>
  Set &
  Named<Set>::operator[](const std::string &name)
  {
    const std::string key = upper_case(name);
    spelling.emplace(key, name);
    return sets[key];
  }

  template <typename Set>
  const Set *
  Named<Set>::find(const std::string &name) const
  {
    const auto found = sets.find(upper_case(name));
    return found == sets.end() ? nullptr : &found->second;
  }

  template struct Named<std::vector<std::uint32_t>>;
  template struct Named<std::vector<FaceOfElement>>;



  void
  Model::check_other_cells(const std::string &path) const
  {
    if (!others.empty())
      {
        std::vector<std::string> found;
        for (const auto &[type, n] : others)
          found.push_back(fmt::format("{} of the type '{}'", n, type));
        throw InputError(
          "",
          path + ": cells other than tetrahedra: found " +
            shortened(join(found), 300) +
            "; allowed are C3D4 and C3D10 with their variants, and triangles "
            "and lines, which give their names to faces and nodes");
      }
  }



  Scope
  Model::add_copy(const Model                         &part,
                  const Scope                         &scope,
                  const std::vector<dealii::Point<3>> &places)
  {
    const std::size_t first_node    = nodes.size();
    const std::size_t first_element = elements.size();
    const std::size_t first_of_all  = element_nodes.size();
    nodes.insert(nodes.end(), places.begin(), places.end());
    for (Element element : part.elements)
      {
        element.first += first_of_all;
        elements.push_back(element);
      }
    for (const std::uint32_t node : part.element_nodes)
      element_nodes.push_back(first_node + node);
    for (const auto &[type, n] : part.others)
      others[type] += n;

    Scope copy = scope;
    for (auto &[tag, node] : copy.nodes)
      node += first_node;
    for (auto &[tag, element] : copy.elements)
      element += first_element;
    for (auto &[name, set] : copy.node_sets.sets)
      for (std::uint32_t &node : set)
        node += first_node;
    for (auto &[name, set] : copy.element_sets.sets)
      for (std::uint32_t &element : set)
        element += first_element;
    for (auto &[name, set] : copy.surfaces.sets)
      for (FaceOfElement &face : set)
        face.element += first_element;
    return copy;
  }



  std::vector<std::uint32_t>
  Model::quadratic_tetrahedra() const
  {
    std::vector<std::uint32_t> result;
    for (const Element &element : elements)
      if (element.kind.shape == Shape::tetrahedron &&
          element.kind.n_nodes == 10)
        {
          const auto first = element_nodes.begin() + element.first;
          result.insert(result.end(), first, first + 10);
        }
    return result;
  }



  ImportedMesh
  imported_mesh(const Model              &model,
                const std::vector<Scope> &scopes,
                const std::string        &path)
  {
    ImportedMesh mesh;
    mesh.origin = path;
    mesh.nodes  = model.nodes;
    const Export all(mesh, model, scopes);
    return mesh;
  }
} // namespace corotet::abaqus
