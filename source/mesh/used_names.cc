// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/mesh/used_names.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

namespace corotet
{
  namespace
  {
    template <typename Part, typename Id>
    NamedSets
    used_names(NamedSets named, const std::vector<Part> &parts, const Id &id)
    {
      std::vector<unsigned int> ids;
      for (const Part &part : parts)
        if (ids.empty() || ids.back() != id(part))
          ids.push_back(id(part));
      named.restrict_to(ids);
      return named;
    }
  } // namespace



  UsedNames::UsedNames(const SerialMesh &mesh)
    : regions(used_names(mesh.regions,
                         mesh.cells,
                         [](const auto &cell) { return cell.region; }))
    , boundaries(used_names(mesh.boundaries,
                            mesh.faces,
                            [](const auto &face) { return face.boundary; }))
    , edges(used_names(mesh.edge_names,
                       mesh.edges,
                       [](const auto &edge) { return edge.id; }))
    , corners(used_names(mesh.corner_names,
                         mesh.corners,
                         [](const auto &corner) { return corner.id; }))
  {}



  void
  UsedNames::broadcast(const MPI_Comm comm)
  {
    using dealii::Utilities::MPI::broadcast;
    for (NamedSets *named : {&regions, &boundaries, &edges, &corners})
      *named = {broadcast(comm, named->names, 0),
                broadcast(comm, named->sets, 0),
                broadcast(comm, named->parts, 0)};
  }
} // namespace corotet
