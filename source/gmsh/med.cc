// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "med.h"

#include <stdexcept>

#ifdef COROTET_MED
#  include <gmsh.h>

#  include <algorithm>
#  include <array>
#  include <iterator>
#  include <map>
#  include <vector>

#  include "med_file.h"

namespace corotet::gmsh_program
{
  namespace
  {
    // A type of elements, with the numbers that MED and gmsh give it. Volumes
    // of all types are counted; surfaces and curves have usable names only if
    // their degree is 1 or 2.
    struct Type
    {
      med_geometry_type med;
      int               gmsh;
      int               dimension;
      // The nodes in gmsh's order, as positions in MED's order. Empty for types
      // that are only counted.
      std::vector<int> order;
      // The same for a mirrored element: MED's tetrahedra are mirrored, but not
      // in the files of all programs.
      std::vector<int> mirrored;
    };

    const std::vector<Type> &
    types()
    {
      static const std::vector<Type> all{
        {MED_TETRA4, 4, 3, {0, 1, 2, 3}, {0, 2, 1, 3}},
        {MED_TETRA10,
         11,
         3,
         {0, 1, 2, 3, 4, 5, 6, 7, 9, 8},
         {0, 2, 1, 3, 6, 5, 4, 7, 8, 9}},
        {MED_HEXA8, 5, 3, {}, {}},
        {MED_HEXA20, 17, 3, {}, {}},
        {MED_HEXA27, 12, 3, {}, {}},
        {MED_PENTA6, 6, 3, {}, {}},
        {MED_PENTA15, 18, 3, {}, {}},
        {MED_PENTA18, 13, 3, {}, {}},
        {MED_PYRA5, 7, 3, {}, {}},
        {MED_PYRA13, 19, 3, {}, {}},
        {MED_TRIA3, 2, 2, {0, 1, 2}, {}},
        {MED_TRIA6, 9, 2, {0, 1, 2, 3, 4, 5}, {}},
        {MED_SEG2, 1, 1, {0, 1}, {}},
        {MED_SEG3, 8, 1, {0, 1, 2}, {}}};
      return all;
    }



    // The entities and groups of one dimension.
    struct Names
    {
      std::map<med_int, int>                  entities;
      std::map<std::string, std::vector<int>> groups;

      // The entity of a family; a new family gets one.
      int
      entity(const med_int                                      family,
             const std::map<med_int, std::vector<std::string>> &known)
      {
        const auto [entry, is_new] =
          entities.try_emplace(family, int(entities.size()) + 1);
        if (is_new)
          if (const auto found = known.find(family); found != known.end())
            for (const std::string &group : found->second)
              groups[group].push_back(entry->second);
        return entry->second;
      }
    };



    // Six times the volume of a tetrahedron with four nodes, which are counted
    // from one.
    double
    volume(const std::vector<double> &coordinates, const med_int *nodes)
    {
      double edges[3][3];
      for (int i = 0; i < 3; ++i)
        for (int d = 0; d < 3; ++d)
          edges[i][d] = coordinates[3 * (nodes[i + 1] - 1) + d] -
                        coordinates[3 * (nodes[0] - 1) + d];
      const auto &[a, b, c] = edges;
      return a[0] * (b[1] * c[2] - b[2] * c[1]) +
             a[1] * (b[2] * c[0] - b[0] * c[2]) +
             a[2] * (b[0] * c[1] - b[1] * c[0]);
    }



    // Elements by their entities, one for each family.
    std::vector<GmshModel::Elements>
    by_entity(const Type                                        &type,
              const std::vector<med_int>                        &nodes,
              const std::vector<med_int>                        &families,
              const std::map<med_int, std::vector<std::string>> &groups,
              const std::vector<double>                         &coordinates,
              Names                                             &names)
    {
      const std::size_t n_nodes = coordinates.size() / 3;
      for (const med_int node : nodes)
        if (node < 1 || std::size_t(node) > n_nodes)
          refuse_med("an element has the node " + std::to_string(node) +
                     " of " + std::to_string(n_nodes));
      std::map<int, GmshModel::Elements> result;
      for (std::size_t e = 0; e < families.size(); ++e)
        {
          const int            entity   = names.entity(families[e], groups);
          GmshModel::Elements &elements = result[entity];
          elements.entity               = entity;
          elements.type                 = type.gmsh;
          const med_int *const first    = &nodes[e * type.order.size()];
          const bool           is_mirrored =
            !type.mirrored.empty() && volume(coordinates, first) < 0;
          for (const int i : is_mirrored ? type.mirrored : type.order)
            elements.nodes.push_back(first[i]);
        }
      std::vector<GmshModel::Elements> list;
      list.reserve(result.size());
      for (auto &[entity, elements] : result)
        list.push_back(std::move(elements));
      return list;
    }



    GmshModel::ElementType
    description(const int type, const std::size_t n_elements)
    {
      GmshModel::ElementType result;
      result.type       = type;
      result.n_elements = n_elements;
      int dimension = 0, degree = 0, n_nodes = 0, n_vertices = 0;
      gmsh::model::mesh::getElementProperties(type,
                                              result.name,
                                              dimension,
                                              degree,
                                              n_nodes,
                                              result.nodes,
                                              n_vertices);
      return result;
    }
  } // namespace



  GmshModel
  read_med(const std::string &path)
  {
    const MedFile file(path);
    const auto    groups = file.groups();
    GmshModel     model;
    Names         names[4];
    const auto    add = [&](std::vector<GmshModel::Elements>  &all,
                         std::vector<GmshModel::Elements> &&more) {
      std::move(more.begin(), more.end(), std::back_inserter(all));
    };
    const std::array<std::vector<GmshModel::Elements> *, 4> elements{
      {&model.points, &model.curves, &model.surfaces, &model.volumes}};
    model.coordinates = file.coordinates();
    for (std::size_t i = 0; i < model.coordinates.size() / 3; ++i)
      model.node_tags.push_back(i + 1);
    for (const Type &type : types())
      {
        const std::size_t n = file.n_elements(type.med);
        if (n == 0)
          continue;
        if (type.dimension == 3)
          model.volume_types.push_back(description(type.gmsh, n));
        if (!type.order.empty())
          add(*elements[type.dimension],
              by_entity(type,
                        file.nodes(type.med, n * type.order.size()),
                        file.families(MED_CELL, type.med, n),
                        groups,
                        model.coordinates,
                        names[type.dimension]));
      }
    if (const std::size_t n = file.n_polyhedra(); n > 0)
      model.volume_types.push_back({0, "Polyhedron", n, {}});
    // Nodes that belong to a group become elements that are points.
    std::vector<med_int> nodes, families;
    const auto           of_nodes =
      file.families(MED_NODE, MED_NONE, model.node_tags.size());
    for (std::size_t i = 0; i < of_nodes.size(); ++i)
      if (groups.contains(of_nodes[i]))
        {
          nodes.push_back(i + 1);
          families.push_back(of_nodes[i]);
        }
    const Type point{MED_POINT1, 15, 0, {0}, {}};
    add(model.points,
        by_entity(point, nodes, families, groups, model.coordinates, names[0]));
    for (const int dimension : {3, 2, 1, 0})
      {
        int id = 0;
        for (const auto &[name, entities] : names[dimension].groups)
          model.groups.push_back({dimension, ++id, name, entities});
      }
    return model;
  }
} // namespace corotet::gmsh_program

#else

namespace corotet::gmsh_program
{
  GmshModel
  read_med(const std::string &)
  {
    throw std::runtime_error("corotet was built without MED's library "
                             "(Debian's package: libmedc-dev)");
  }
} // namespace corotet::gmsh_program

#endif
