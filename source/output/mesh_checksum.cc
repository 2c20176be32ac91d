// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/checkpoint_checksum.h>
#include <corotet/output/mesh_checksum.h>

#include <deal.II/base/mpi.h>

#include <array>
#include <bit>
#include <cstdint>
#include <map>

namespace corotet
{
  std::string
  mesh_checksum(const Mesh &mesh)
  {
    // The positions of a cell's words: its region, the coordinates of its
    // vertices, the names of its parts, and the nodes of its map.
    constexpr unsigned int n_words = 128, first_vertex = 1, first_face = 13,
                           first_edge = 17, first_corner = 23, first_node = 27;
    const LocalMesh &local = mesh.local();
    std::uint64_t    sum   = 0;
    const auto       add   = [&](const unsigned int  cell,
                         const unsigned int  word,
                         const std::uint64_t value) {
      sum += checkpoint_checksum::of_word(value,
                                          n_words * local.numbers[cell] + word);
    };
    const auto add_points = [&](const unsigned int cell,
                                const unsigned int word,
                                const auto        &points) {
      for (unsigned int i = 0; i < points.size(); ++i)
        for (unsigned int a = 0; a < 3; ++a)
          add(cell,
              word + 3 * i + a,
              std::bit_cast<std::uint64_t>(points[i][a]));
    };
    const auto by_names = [](const MeshNames &names) {
      return [&names, known = std::map<unsigned int, std::uint64_t>()](
               const unsigned int id) mutable {
        const auto [place, is_new] = known.try_emplace(id, 0);
        if (is_new)
          {
            const std::string name = names.name(id);
            place->second =
              checkpoint_checksum::of_bytes(name.data(), name.size(), 0);
          }
        return place->second;
      };
    };
    auto region = by_names(mesh.regions());
    for (unsigned int c = 0; c < local.cells.size(); ++c)
      {
        if (!local.is_owned(c))
          continue;
        std::array<dealii::Point<3>, 4> vertices;
        for (unsigned int k = 0; k < 4; ++k)
          vertices[k] = local.vertices[local.cells[c].vertices[k]];
        add(c, 0, region(local.cells[c].region));
        add_points(c, first_vertex, vertices);
        add_points(c, first_node, mesh.curved_nodes(c));
      }
    const auto add_parts = [&](const std::vector<CellPart> &parts,
                               const unsigned int           word,
                               const MeshNames             &names) {
      auto name = by_names(names);
      for (const auto &[cell, number, id] : parts)
        if (local.is_owned(cell))
          add(cell, word + number, name(id));
    };
    add_parts(local.faces, first_face, mesh.places().boundaries);
    add_parts(local.edges, first_edge, mesh.places().edges);
    add_parts(local.corners, first_corner, mesh.places().corners);
    return checkpoint_checksum::in_words(
      dealii::Utilities::MPI::sum(sum, mesh.communicator()));
  }
} // namespace corotet
