// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_model_builder_h
#define corotet_source_mesh_model_builder_h

#include <corotet/mesh/gmsh_model.h>

#include <deal.II/base/point.h>

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace corotet
{
  /// A type of gmsh's elements.
  struct GmshType
  {
    int          dimension;
    unsigned int n_nodes;
    std::string  name;
  };

  /// All known types by gmsh's numbers.
  const std::map<int, GmshType> &
  gmsh_types();



  /// Assigns consecutive indices to numbers, in the order in which they are
  /// added. Takes no additional memory while numbers ascend, as they mostly do.
  class GivenNumbers
  {
  public:
    /// Gives the next index to a number. If it has one already, returns that
    /// instead.
    std::optional<std::size_t>
    add(const std::uint64_t number);

    const std::vector<std::uint64_t> &
    all() const
    {
      return numbers;
    }

  private:
    std::vector<std::uint64_t> numbers;
    // Used once a number was smaller than the one before.
    std::unordered_map<std::uint64_t, std::size_t> places;
  };



  /**
   * Makes a GmshModel of nodes and elements, for files with a reader of our
   * own. An element may be in any number of groups: elements of one dimension
   * that are in the same groups become one entity.
   */
  class ModelBuilder
  {
  public:
    /// Adds a node. Returns false if there is a node with this tag at another
    /// place.
    [[nodiscard]] bool
    add_node(const std::uint64_t tag, const dealii::Point<3> &x);

    /// Adds an element and returns its number. @p type is one of gmsh_types(),
    /// and the nodes @p of_element are in gmsh's order.
    std::size_t
    add_element(const int                            type,
                const std::span<const std::uint64_t> of_element);

    std::size_t
    n_elements() const
    {
      return elements.size();
    }

    int
    dimension(const std::size_t element) const
    {
      return gmsh_types().at(elements[element].type).dimension;
    }

    /// Adds an element to a group; @p group is its number in the element's
    /// dimension, 0 or more.
    void
    add_to_group(const std::size_t element, const int group);

    bool
    has_group(const std::size_t element) const
    {
      return elements[element].combination != 0;
    }

    void
    name_group(const int dimension, const int group, const std::string &name)
    {
      names[{dimension, group}] = name;
    }

    /// Unites elements of the same type and nodes, in the groups of all of
    /// them: some programs write an element once for each of its groups.
    /// Elements that are in the same group twice stay separate.
    void
    join_copies();

    GmshModel
    model() const;

  private:
    struct Element
    {
      int           type;
      std::uint32_t combination;
      std::size_t   first_node;
    };

    std::span<const std::uint64_t>
    nodes_of(const Element &element) const
    {
      return {nodes.data() + element.first_node,
              gmsh_types().at(element.type).n_nodes};
    }

    // Whether two elements have the same nodes, in any order.
    bool
    are_copies(const Element &a, const Element &b) const;

    // Adds the groups of a copy to an element. Returns false if @p other is not
    // a copy, or if they have a common group, or one has no group.
    bool
    join(const std::size_t first, const std::size_t other);

    GivenNumbers                               tags;
    std::vector<double>                        coordinates;
    std::vector<Element>                       elements;
    std::vector<std::uint64_t>                 nodes;
    std::map<std::pair<int, int>, std::string> names;
    // Sorted groups of each combination; the first one has no group.
    std::vector<std::vector<int>> combinations{{}};
    // The combination that results from one with an added group.
    std::map<std::pair<std::uint32_t, int>, std::uint32_t> with_group;
    std::map<std::vector<int>, std::uint32_t>              numbers{{{}, 0}};
  };
} // namespace corotet

#endif
