// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/gmsh_elements.h>

#include <fmt/format.h>

#include <map>

namespace corotet::gmsh_elements
{
  namespace
  {
    // gmsh's reference tetrahedron is deal.II's. This is checked, since a
    // damaged process of gmsh may return anything.
    std::vector<unsigned int>
    node_order(const std::vector<double> &theirs,
               const unsigned int         degree,
               const std::string         &path)
    {
      std::vector<unsigned int> order;
      for (const dealii::Point<3> &ours : map_points(degree))
        for (std::size_t j = 0; j < theirs.size() / 3; ++j)
          if (ours.distance(
                {theirs[3 * j], theirs[3 * j + 1], theirs[3 * j + 2]}) < 1e-6)
            {
              order.push_back(j);
              break;
            }
      if (order.size() != map_points(degree).size())
        throw InputError("",
                         path + ": gmsh has handed back other reference nodes "
                                "than those of its tetrahedra; is the file "
                                "damaged?");
      return order;
    }
  } // namespace



  Tetrahedra
  tetrahedra(const GmshModel &model, const std::string &path)
  {
    const std::map<int, unsigned int> degrees{{4, 1}, {11, 2}, {29, 3}};
    std::vector<std::string>          others, kinds;
    Tetrahedra                        result{};
    for (const GmshModel::ElementType &type : model.volume_types)
      if (const auto found = degrees.find(type.type); found != degrees.end())
        {
          result = {type.type,
                    found->second,
                    node_order(type.nodes, found->second, path)};
          kinds.push_back("'" + type.name + "'");
        }
      else
        others.push_back(
          fmt::format("{} of the type '{}'", type.n_elements, type.name));
    if (!others.empty())
      throw InputError("",
                       path +
                         ": cells other than tetrahedra with 4, 10 or 20 "
                         "nodes: found " +
                         join(others) +
                         "; allowed are 'Tetrahedron 4', 'Tetrahedron 10' and "
                         "'Tetrahedron 20'");
    if (kinds.empty())
      throw InputError("", path + ": the mesh has no tetrahedra");
    if (kinds.size() > 1)
      throw InputError("",
                       path + ": tetrahedra of several degrees: found " +
                         join(kinds) + "; one of these is allowed");
    return result;
  }
} // namespace corotet::gmsh_elements
