// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "model_builder.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <set>

#include "msh_nodes.h"

namespace corotet
{
  namespace
  {
    // A hash of a number.
    std::uint64_t
    mixed(std::uint64_t x)
    {
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
      return x ^ (x >> 31);
    }



    // The reference coordinates of the nodes of tetrahedra with 4, 10 and 20
    // nodes; empty for other types.
    std::vector<double>
    reference_nodes(const int type)
    {
      const std::map<int, unsigned int> degrees{{4, 1}, {11, 2}, {29, 3}};
      const auto                        degree = degrees.find(type);
      std::vector<double>               result;
      if (degree != degrees.end())
        for (const MshNode &node : tetrahedron_nodes[degree->second - 1])
          {
            std::array<double, 3> xi{};
            for (const unsigned int corner : node)
              if (corner > 0)
                xi[corner - 1] += 1. / node.size();
            result.insert(result.end(), xi.begin(), xi.end());
          }
      return result;
    }
  } // namespace



  const std::map<int, GmshType> &
  gmsh_types()
  {
    static const std::map<int, GmshType> types{
      {1, {1, 2, "Line 2"}},
      {2, {2, 3, "Triangle 3"}},
      {3, {2, 4, "Quadrilateral 4"}},
      {4, {3, 4, "Tetrahedron 4"}},
      {5, {3, 8, "Hexahedron 8"}},
      {6, {3, 6, "Prism 6"}},
      {7, {3, 5, "Pyramid 5"}},
      {8, {1, 3, "Line 3"}},
      {9, {2, 6, "Triangle 6"}},
      {10, {2, 9, "Quadrilateral 9"}},
      {11, {3, 10, "Tetrahedron 10"}},
      {12, {3, 27, "Hexahedron 27"}},
      {13, {3, 18, "Prism 18"}},
      {14, {3, 14, "Pyramid 14"}},
      {15, {0, 1, "Point"}},
      {16, {2, 8, "Quadrilateral 8"}},
      {17, {3, 20, "Hexahedron 20"}},
      {18, {3, 15, "Prism 15"}},
      {19, {3, 13, "Pyramid 13"}},
      {20, {2, 9, "Triangle 9"}},
      {21, {2, 10, "Triangle 10"}},
      {22, {2, 12, "Triangle 12"}},
      {23, {2, 15, "Triangle 15"}},
      {24, {2, 15, "Triangle 15I"}},
      {25, {2, 21, "Triangle 21"}},
      {26, {1, 4, "Line 4"}},
      {27, {1, 5, "Line 5"}},
      {28, {1, 6, "Line 6"}},
      {29, {3, 20, "Tetrahedron 20"}},
      {30, {3, 35, "Tetrahedron 35"}},
      {31, {3, 56, "Tetrahedron 56"}},
      {36, {2, 16, "Quadrilateral 16"}},
      {37, {2, 25, "Quadrilateral 25"}},
      {90, {3, 40, "Prism 40"}},
      {92, {3, 64, "Hexahedron 64"}},
      {93, {3, 125, "Hexahedron 125"}},
      {118, {3, 30, "Pyramid 30"}}};
    return types;
  }



  std::optional<std::size_t>
  GivenNumbers::add(const std::uint64_t number)
  {
    if (!places.empty() || (!numbers.empty() && number <= numbers.back()))
      {
        if (places.empty())
          for (std::size_t i = 0; i < numbers.size(); ++i)
            places.emplace(numbers[i], i);
        const auto [place, is_new] = places.emplace(number, numbers.size());
        if (!is_new)
          return place->second;
      }
    numbers.push_back(number);
    return {};
  }



  bool
  ModelBuilder::add_node(const std::uint64_t tag, const dealii::Point<3> &x)
  {
    if (const auto before = tags.add(tag))
      return std::equal(x.begin_raw(),
                        x.end_raw(),
                        coordinates.begin() + 3 * *before);
    coordinates.insert(coordinates.end(), x.begin_raw(), x.end_raw());
    return true;
  }



  std::size_t
  ModelBuilder::add_element(const int                            type,
                            const std::span<const std::uint64_t> of_element)
  {
    elements.push_back({type, 0, nodes.size()});
    nodes.insert(nodes.end(), of_element.begin(), of_element.end());
    return elements.size() - 1;
  }



  void
  ModelBuilder::add_to_group(const std::size_t element, const int group)
  {
    std::uint32_t &combination = elements[element].combination;
    const auto [known, is_new] =
      with_group.try_emplace({combination, group}, combination);
    if (is_new)
      {
        std::vector<int> groups = combinations[combination];
        const auto       place =
          std::lower_bound(groups.begin(), groups.end(), group);
        if (place == groups.end() || *place != group)
          {
            groups.insert(place, group);
            const auto [number, is_first] =
              numbers.try_emplace(groups, combinations.size());
            if (is_first)
              combinations.push_back(groups);
            known->second = number->second;
          }
      }
    combination = known->second;
  }



  bool
  ModelBuilder::are_copies(const Element &a, const Element &b) const
  {
    const auto of_a = nodes_of(a), of_b = nodes_of(b);
    return a.type == b.type &&
           std::is_permutation(of_a.begin(), of_a.end(), of_b.begin());
  }



  bool
  ModelBuilder::join(const std::size_t first, const std::size_t other)
  {
    if (!are_copies(elements[first], elements[other]))
      return false;
    // These are copies, as adding groups changes the list of combinations.
    const std::vector<int> of_first = combinations[elements[first].combination],
                           of_other = combinations[elements[other].combination];
    std::vector<int> both;
    std::set_intersection(of_first.begin(),
                          of_first.end(),
                          of_other.begin(),
                          of_other.end(),
                          std::back_inserter(both));
    if (!both.empty() || of_first.empty() || of_other.empty())
      return false;
    for (const int group : of_other)
      add_to_group(first, group);
    return true;
  }



  void
  ModelBuilder::join_copies()
  {
    std::vector<std::uint64_t> keys(elements.size());
    for (std::size_t e = 0; e < elements.size(); ++e)
      {
        keys[e] = elements[e].type;
        for (const std::uint64_t node : nodes_of(elements[e]))
          keys[e] += mixed(node);
      }
    std::vector<std::size_t> order(elements.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(),
                     order.end(),
                     [&](const std::size_t a, const std::size_t b) {
                       return keys[a] < keys[b];
                     });
    // A limit of comparisons, so that damaged files do not take forever.
    constexpr std::size_t most = 1000;
    std::vector<bool>     is_joined(elements.size());
    for (std::size_t i = 0; i < order.size(); ++i)
      for (std::size_t j = i + 1;
           j < std::min(order.size(), i + most) &&
           keys[order[j]] == keys[order[i]] && !is_joined[order[i]];
           ++j)
        if (!is_joined[order[j]])
          is_joined[order[j]] = join(order[i], order[j]);
    std::size_t n = 0;
    for (std::size_t e = 0; e < elements.size(); ++e)
      if (!is_joined[e])
        elements[n++] = elements[e];
    elements.resize(n);
  }



  GmshModel
  ModelBuilder::model() const
  {
    GmshModel model;
    model.node_tags   = tags.all();
    model.coordinates = coordinates;
    const std::array<std::vector<GmshModel::Elements> *, 4> all{
      {&model.points, &model.curves, &model.surfaces, &model.volumes}};
    // Cells of other types are only counted.
    const std::set<int>          used{1, 2, 4, 8, 9, 11, 15, 21, 26, 29};
    std::map<int, std::uint64_t> n_volumes;
    std::map<std::pair<int, int>, std::size_t>             places;
    std::map<std::pair<int, int>, std::set<std::uint32_t>> entities;
    for (const Element &element : elements)
      {
        const int dimension = gmsh_types().at(element.type).dimension;
        const int entity    = static_cast<int>(element.combination) + 1;
        if (dimension == 3)
          ++n_volumes[element.type];
        if (!used.contains(element.type) ||
            (dimension < 2 && element.combination == 0))
          continue;
        for (const int group : combinations[element.combination])
          entities[{dimension, group}].insert(entity);
        const auto [place, is_new] =
          places.try_emplace({element.type, entity}, all[dimension]->size());
        if (is_new)
          all[dimension]->push_back({entity, element.type, {}});
        const auto own         = nodes_of(element);
        auto      &tags_of_all = (*all[dimension])[place->second].nodes;
        tags_of_all.insert(tags_of_all.end(), own.begin(), own.end());
      }
    for (const auto &[type, n] : n_volumes)
      model.volume_types.push_back(
        {type, gmsh_types().at(type).name, n, reference_nodes(type)});
    for (const auto &[group, members] : entities)
      {
        const auto name = names.find(group);
        model.groups.push_back({group.first,
                                group.second,
                                name == names.end() ? "" : name->second,
                                {members.begin(), members.end()}});
      }
    return model;
  }
} // namespace corotet
