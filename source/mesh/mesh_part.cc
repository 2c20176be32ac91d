// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>
#include <corotet/base/mpi.h>
#include <corotet/base/number_table.h>
#include <corotet/mesh/cell_order.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/mesh_part.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

namespace corotet
{
  namespace
  {
    constexpr unsigned int not_there = dealii::numbers::invalid_unsigned_int;



    // Calls @p action for each array of a message, in order.
    template <typename Part, typename Action>
    void
    for_each_array(Part &part, const Action &action)
    {
      action(part.vertices);
      action(part.vertex_numbers);
      action(part.cells);
      action(part.numbers);
      action(part.faces);
      action(part.edges);
      action(part.corners);
      action(part.curved_nodes);
    }



    // Copies the curve of a cell, if it has one, from @p from to @p to.
    void
    copy_curve(MeshPart &to, MeshCells::Cell &cell, const MeshPart &from)
    {
      if (cell.curve == MeshCells::straight)
        return;
      const dealii::Point<3> *nodes = curved_nodes(from, cell);
      cell.curve = to.curved_nodes.size() / from.n_map_nodes();
      to.curved_nodes.insert(to.curved_nodes.end(),
                             nodes,
                             nodes + from.n_map_nodes());
    }



    void
    sort_by_cells(std::vector<CellPart> &list)
    {
      std::stable_sort(list.begin(),
                       list.end(),
                       [](const CellPart &a, const CellPart &b) {
                         return a.cell < b.cell;
                       });
    }



    // The parts in a sorted list that belong to cells with a new number. All of
    // these cells are from @p first_cell to @p last_cell.
    std::vector<CellPart>
    chosen(const std::vector<CellPart>     &list,
           const unsigned int               first_cell,
           const unsigned int               last_cell,
           const std::vector<unsigned int> &new_cells)
    {
      std::vector<CellPart> result;
      for (auto p = std::lower_bound(list.begin(),
                                     list.end(),
                                     first_cell,
                                     [](const CellPart    &part,
                                        const unsigned int cell) {
                                       return part.cell < cell;
                                     });
           p != list.end() && p->cell <= last_cell;
           ++p)
        if (new_cells[p->cell] != not_there)
          result.push_back({new_cells[p->cell], p->number, p->id});
      sort_by_cells(result);
      return result;
    }
  } // namespace



  PartCutter::PartCutter(const MeshPart &part)
    : part(part)
    , new_vertices(part.vertices.size(), not_there)
    , new_cells(part.cells.size(), not_there)
  {}



  MeshPart
  PartCutter::cut(const std::vector<unsigned int> &cells)
  {
    MeshPart result;
    result.geometry_degree = part.geometry_degree;
    result.cells.reserve(cells.size());
    result.numbers.reserve(cells.size());
    std::vector<unsigned int> used;
    for (const unsigned int c : cells)
      {
        new_cells[c]           = result.cells.size();
        SerialMesh::Cell &cell = result.cells.emplace_back(part.cells[c]);
        result.numbers.push_back(part.numbers[c]);
        for (unsigned int &v : cell.vertices)
          {
            if (new_vertices[v] == not_there)
              {
                new_vertices[v] = used.size();
                used.push_back(v);
              }
            v = new_vertices[v];
          }
        copy_curve(result, cell, part);
      }
    result.vertices.reserve(used.size());
    result.vertex_numbers.reserve(used.size());
    for (const unsigned int v : used)
      {
        result.vertices.push_back(part.vertices[v]);
        result.vertex_numbers.push_back(part.vertex_numbers[v]);
        new_vertices[v] = not_there;
      }
    if (!cells.empty())
      {
        const auto [first, last] =
          std::minmax_element(cells.begin(), cells.end());
        result.faces   = chosen(part.faces, *first, *last, new_cells);
        result.edges   = chosen(part.edges, *first, *last, new_cells);
        result.corners = chosen(part.corners, *first, *last, new_cells);
      }
    for (const unsigned int c : cells)
      new_cells[c] = not_there;
    return result;
  }



  MeshPart
  merged(const std::vector<MeshPart>                              &parts,
         const std::vector<std::pair<unsigned int, unsigned int>> &order)
  {
    MeshPart                               result;
    std::vector<std::vector<unsigned int>> new_vertices, new_cells;
    std::size_t                            n_vertices = 0;
    for (const MeshPart &part : parts)
      {
        n_vertices += part.vertices.size();
        new_vertices.emplace_back(part.vertices.size(), not_there);
        new_cells.emplace_back(part.cells.size(), not_there);
        result.geometry_degree = part.geometry_degree;
      }
    NumberTable vertices(n_vertices);
    result.vertices.reserve(n_vertices);
    result.cells.reserve(order.size());
    result.numbers.reserve(order.size());
    for (const auto &[p, c] : order)
      {
        const MeshPart &part = parts[p];
        new_cells[p][c]      = result.cells.size();
        result.numbers.push_back(part.numbers[c]);
        SerialMesh::Cell &cell = result.cells.emplace_back(part.cells[c]);
        for (unsigned int &v : cell.vertices)
          {
            unsigned int &index = new_vertices[p][v];
            if (index == not_there)
              {
                index = vertices.index_of(part.vertex_numbers[v]);
                if (index == result.vertices.size())
                  result.vertices.push_back(part.vertices[v]);
              }
            v = index;
          }
        copy_curve(result, cell, part);
      }
    result.vertex_numbers = vertices.numbers();
    for (std::vector<CellPart> MeshPart::*list :
         {&MeshPart::faces, &MeshPart::edges, &MeshPart::corners})
      {
        for (unsigned int p = 0; p < parts.size(); ++p)
          for (const auto &[c, number, id] : parts[p].*list)
            if (new_cells[p][c] != not_there)
              (result.*list).push_back({new_cells[p][c], number, id});
        sort_by_cells(result.*list);
      }
    return result;
  }



  void
  sort_vertices(MeshPart &part)
  {
    // Most vertices are in order already, except those of other ranks' cells.
    using NumberedVertex = std::pair<std::uint64_t, unsigned int>;
    std::vector<NumberedVertex> order, others;
    order.reserve(part.vertices.size());
    for (unsigned int v = 0; v < part.vertices.size(); ++v)
      {
        const NumberedVertex numbered(part.vertex_numbers[v], v);
        (order.empty() || order.back() < numbered ? order : others)
          .push_back(numbered);
      }
    std::sort(others.begin(), others.end());
    const std::size_t n_in_order = order.size();
    order.insert(order.end(), others.begin(), others.end());
    std::inplace_merge(order.begin(), order.begin() + n_in_order, order.end());
    std::vector<unsigned int>     new_index(order.size());
    std::vector<dealii::Point<3>> vertices;
    vertices.reserve(order.size());
    for (unsigned int i = 0; i < order.size(); ++i)
      {
        const auto &[number, v] = order[i];
        part.vertex_numbers[i]  = number;
        vertices.push_back(part.vertices[v]);
        new_index[v] = i;
      }
    for (MeshCells::Cell &cell : part.cells)
      for (unsigned int &v : cell.vertices)
        v = new_index[v];
    part.vertices = std::move(vertices);
  }



  std::vector<std::byte>
  packed(const MeshPart &part)
  {
    std::size_t n_bytes = sizeof(part.geometry_degree) + sizeof(std::size_t);
    for_each_array(part, [&](const auto &array) {
      n_bytes += sizeof(std::size_t) + array.size() * sizeof(array[0]);
    });
    std::vector<std::byte> message;
    message.reserve(n_bytes);
    append_array(message, std::vector<unsigned int>{part.geometry_degree});
    for_each_array(part,
                   [&](const auto &array) { append_array(message, array); });
    return message;
  }



  MeshPart
  unpacked(const std::vector<std::byte> &message, std::size_t &position)
  {
    MeshPart                  part;
    std::vector<unsigned int> degree;
    read_array(message, position, degree);
    part.geometry_degree = degree[0];
    for_each_array(part,
                   [&](auto &array) { read_array(message, position, array); });
    return part;
  }



  MeshPart
  whole_part(SerialMesh &mesh, NamedParts &&named_parts)
  {
    MeshPart part;
    static_cast<MeshCells &>(part) = std::move(static_cast<MeshCells &>(mesh));
    part.numbers.resize(part.cells.size());
    std::iota(part.numbers.begin(), part.numbers.end(), 0);
    part.vertex_numbers.resize(part.vertices.size());
    std::iota(part.vertex_numbers.begin(), part.vertex_numbers.end(), 0);
    part.faces   = std::move(named_parts.faces);
    part.edges   = std::move(named_parts.edges);
    part.corners = std::move(named_parts.corners);
    return part;
  }



  SerialMesh
  serial_mesh(MeshPart &&part)
  {
    SerialMesh mesh;
    for (const auto &[c, f, id] : part.faces)
      {
        const auto &v        = part.cells[c].vertices;
        const auto [i, j, k] = corners_of_faces[f];
        mesh.faces.push_back({{{v[i], v[j], v[k]}}, id});
      }
    // Edges and vertices that several cells share are listed in each of these
    // cells.
    using Ends = std::array<unsigned int, 2>;
    std::set<std::pair<Ends, unsigned int>>         edges;
    std::set<std::pair<unsigned int, unsigned int>> corners;
    for (const auto &[c, e, id] : part.edges)
      {
        const auto &v      = part.cells[c].vertices;
        const auto &[a, b] = ends_of_edges[e];
        edges.emplace(ascending_ends(v[a], v[b]), id);
      }
    for (const auto &[c, k, id] : part.corners)
      corners.emplace(part.cells[c].vertices[k], id);
    for (const auto &[ends, id] : edges)
      mesh.edges.push_back({ends, id});
    for (const auto &[vertex, id] : corners)
      mesh.corners.push_back({vertex, id});
    static_cast<MeshCells &>(mesh) = std::move(static_cast<MeshCells &>(part));
    return mesh;
  }



  MeshPart
  scatter(MeshPart &&whole, const MPI_Comm comm)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int my_rank = MPI::this_mpi_process(comm);
    const unsigned int n_ranks = MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return std::move(whole);

    const MeshPart                         mesh = std::move(whole);
    std::unique_ptr<PartCutter>            cutter;
    std::vector<std::vector<unsigned int>> pieces;
    on_root(comm, [&] {
      cutter = std::make_unique<PartCutter>(mesh);
      pieces = pieces_of_curve(mesh, n_ranks);
    });
    const auto piece = [&](const unsigned int rank) {
      return cutter->cut(std::exchange(pieces[rank], {}));
    };
    // Arrays are sent one by one: copying them all into one message would
    // double the time.
    MeshPart           result;
    const unsigned int degree = MPI::broadcast(comm, mesh.geometry_degree, 0);
    for (unsigned int rank = 1; rank < n_ranks; ++rank)
      {
        MeshPart sent;
        on_root(comm, [&] { sent = piece(rank); });
        if (my_rank == 0)
          for_each_array(sent, [&](const auto &array) {
            send_array(array, rank, comm);
          });
        else if (my_rank == rank)
          {
            result.geometry_degree = degree;
            for_each_array(result,
                           [&](auto &array) { receive_array(array, 0, comm); });
          }
      }
    on_root(comm, [&] { result = piece(0); });
    return result;
  }
} // namespace corotet
