// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/exchange.h>
#include <corotet/base/hdf5_tables.h>
#include <corotet/base/mpi.h>
#include <corotet/base/number_table.h>
#include <corotet/base/timing.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/hdf5_mesh.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "hdf5_mesh_description.h"

namespace corotet
{
  using namespace hdf5_mesh;

  namespace
  {
    namespace MPI = dealii::Utilities::MPI;
    using nlohmann::json;

    // The rows of this rank, if @p n rows are divided evenly.
    Hdf5Rows
    own_rows(const hsize_t n, const hsize_t n_columns, const MPI_Comm comm)
    {
      const hsize_t rank  = MPI::this_mpi_process(comm);
      const hsize_t ranks = MPI::n_mpi_processes(comm);
      const hsize_t first = n * rank / ranks;
      return {first, n * (rank + 1) / ranks - first, n, n_columns};
    }

    // The rank that row @p i belongs to in own_rows().
    unsigned int
    owner_of_row(const hsize_t i, const hsize_t n, const MPI_Comm comm)
    {
      const hsize_t ranks = MPI::n_mpi_processes(comm);
      hsize_t       rank  = i * ranks / n;
      while (n * (rank + 1) / ranks <= i)
        ++rank;
      return rank;
    }

    // The tables of a file: their sizes, and the rows that this rank reads.
    struct Tables
    {
      Tables(const std::string &path, const MPI_Comm comm)
        : path(path)
        , comm(comm)
        , file(path)
        , n_vertices(file.n_rows("vertices", 3))
        , n_cells(file.n_rows("cells", 4))
        , n_curved_nodes(file.n_rows("curved_nodes", 3))
        , cell_rows(own_rows(n_cells, 4, comm))
      {
        if (file.n_rows("regions", 0) != n_cells ||
            file.n_rows("curves", 0) != n_cells)
          refuse(path, "found other numbers of cells, regions and curves");
        if (n_cells == 0)
          refuse(path, "found no cells");
        if (n_vertices == 0)
          refuse(path, "found no vertices");
        check_number_of_cells(n_cells, 0);
      }

      // Reads a table; all numbers must be from @p lowest to below @p end.
      std::vector<std::int64_t>
      integers(const std::string  &name,
               const Hdf5Rows     &rows,
               const std::int64_t  lowest,
               const std::uint64_t end) const
      {
        std::vector<std::int64_t> numbers = file.read<std::int64_t>(name, rows);
        for (const std::int64_t i : numbers)
          if (i < lowest || (i >= 0 && static_cast<std::uint64_t>(i) >= end))
            refuse(path,
                   fmt::format("table '{}': found the number {}; {} to {} are "
                               "allowed",
                               name,
                               i,
                               lowest,
                               static_cast<std::int64_t>(end) - 1));
        return numbers;
      }

      std::vector<dealii::Point<3>>
      points(const std::string &name, const Hdf5Rows &rows) const
      {
        const std::vector<double>     x = file.read<double>(name, rows);
        std::vector<dealii::Point<3>> result;
        result.reserve(rows.n_rows);
        for (std::size_t i = 0; i < x.size(); i += 3)
          {
            result.emplace_back(x[i], x[i + 1], x[i + 2]);
            if (!std::isfinite(result.back().norm_square()))
              refuse(path,
                     fmt::format("table '{}': found the coordinates {}",
                                 name,
                                 position(result.back())));
          }
        return result;
      }


      const std::string path;
      const MPI_Comm    comm;
      const Hdf5Tables  file;
      const hsize_t     n_vertices, n_cells, n_curved_nodes;
      const Hdf5Rows    cell_rows;
    };

    void
    read_description(SpreadMesh &mesh, const std::string &path)
    {
      const Hdf5Tables file(path);
      const hsize_t    n = file.n_rows("description", 0);
      const auto bytes   = file.read<std::uint8_t>("description", {0, n, n, 0});
      try
        {
          const json text  = json::parse(bytes.begin(), bytes.end());
          const int  found = text.at("corotet mesh").get<int>();
          if (found != hdf5_mesh::version)
            throw InputError("",
                             fmt::format("{}: found version {} of corotet's "
                                         "mesh files; {} is allowed",
                                         path,
                                         found,
                                         hdf5_mesh::version));
          mesh.names.regions    = from_json(text.at("regions"), path);
          mesh.names.boundaries = from_json(text.at("boundaries"), path);
          mesh.names.edges      = from_json(text.at("edges"), path);
          mesh.names.corners    = from_json(text.at("corners"), path);
          mesh.part.geometry_degree =
            text.at("geometry degree").get<unsigned int>();
          // Files of the first program versions do not have this entry.
          mesh.faceted =
            text.value("faceted", json::array()).get<std::set<unsigned int>>();
        }
      catch (const json::exception &error)
        {
          refuse(path, std::string("table 'description': ") + error.what());
        }
      if (mesh.part.geometry_degree < 1 || mesh.part.geometry_degree > 3)
        refuse(path,
               fmt::format("found the geometry degree {}; 1 to 3 are allowed",
                           mesh.part.geometry_degree));
      for (const unsigned int id : mesh.faceted)
        if (id != no_boundary && !mesh.names.boundaries.names.contains(id))
          refuse(path,
                 fmt::format("found the faceted boundary {}, which has no name",
                             id));
      if (!mesh.faceted.empty())
        mesh.remarks.push_back(
          remark_on_facets(mesh.faceted, mesh.names.boundaries));
    }

    // Reads the cells; returns their vertices by their numbers in the file.
    std::vector<std::array<std::uint64_t, 4>>
    read_cells(SpreadMesh &mesh, const Tables &tables)
    {
      MeshPart      &part = mesh.part;
      const Hdf5Rows rows = tables.cell_rows;
      const Hdf5Rows list{rows.first, rows.n_rows, rows.n_global_rows, 0};
      const hsize_t  n_of_map   = part.n_map_nodes();
      const hsize_t  n_curves   = tables.n_curved_nodes / n_of_map;
      const bool     has_curves = part.geometry_degree > 1;
      if (tables.n_curved_nodes != (has_curves ? n_curves * n_of_map : 0))
        refuse(tables.path, "found nodes of half a curved cell");
      const auto vertices =
        tables.integers("cells", rows, 0, tables.n_vertices);
      const auto regions =
        tables.integers("regions", list, 0, unnamed_boundary);
      const auto curves =
        tables.integers("curves", list, -1, has_curves ? n_curves : 0);

      std::vector<std::array<std::uint64_t, 4>> result;
      std::int64_t                              first_curve = -1;
      unsigned int                              n_own       = 0;
      for (hsize_t c = 0; c < rows.n_rows; ++c)
        {
          MeshCells::Cell &cell = part.cells.emplace_back();
          auto            &v    = result.emplace_back();
          std::copy_n(vertices.begin() + 4 * c, 4, v.begin());
          part.numbers.push_back(rows.first + c);
          cell.region = regions[c];
          if (!mesh.names.regions.names.contains(cell.region))
            refuse(tables.path,
                   fmt::format("found the region {}, which has no name",
                               cell.region));
          if (curves[c] < 0)
            continue;
          if (first_curve < 0)
            first_curve = curves[c];
          if (curves[c] != first_curve + n_own)
            refuse(tables.path, "found curved cells in another order");
          cell.curve = n_own++;
        }
      part.curved_nodes =
        tables.points("curved_nodes",
                      {n_of_map * std::max<std::int64_t>(first_curve, 0),
                       n_of_map * n_own,
                       tables.n_curved_nodes,
                       3});
      return result;
    }

    // Gets the vertices of the cells from the ranks that have read them.
    void
    fetch_vertices(MeshPart                                        &part,
                   const std::vector<std::array<std::uint64_t, 4>> &cells,
                   const std::vector<dealii::Point<3>>             &own,
                   const Tables                                    &tables)
    {
      NumberTable met;
      for (std::size_t c = 0; c < cells.size(); ++c)
        for (unsigned int k = 0; k < 4; ++k)
          part.cells[c].vertices[k] = met.index_of(cells[c][k]);
      // The numbers are ascending, like the ranks that answer.
      std::vector<std::uint64_t> &numbers = part.vertex_numbers;
      numbers                             = met.numbers();
      std::sort(numbers.begin(), numbers.end());
      std::vector<unsigned int> new_index(numbers.size());
      for (unsigned int v = 0; v < numbers.size(); ++v)
        new_index[met.index_of(numbers[v])] = v;
      for (MeshCells::Cell &cell : part.cells)
        for (unsigned int &v : cell.vertices)
          v = new_index[v];

      using Numbers = std::vector<std::uint64_t>;
      std::map<unsigned int, Numbers> asked;
      for (const std::uint64_t number : numbers)
        asked[owner_of_row(number, tables.n_vertices, tables.comm)].push_back(
          number);
      const hsize_t first = own_rows(tables.n_vertices, 3, tables.comm).first;
      std::map<unsigned int, std::vector<dealii::Point<3>>> answers;
      for (const auto &[rank, questions] : exchange_arrays(asked, tables.comm))
        for (const std::uint64_t number : questions)
          answers[rank].push_back(own[number - first]);
      // Ranks are ascending, and so are the vertices of each.
      for (const auto &[rank, points] : exchange_arrays(answers, tables.comm))
        part.vertices.insert(part.vertices.end(), points.begin(), points.end());
    }

    // A named part of a cell in the file.
    struct StoredPart
    {
      std::uint64_t cell;
      unsigned int  number;
      unsigned int  id;
    };

    std::vector<StoredPart>
    read_names(const std::string &table,
               const unsigned int n_in_cell,
               const NamedSets   &named,
               const Tables      &tables)
    {
      const auto rows = own_rows(tables.file.n_rows(table, 3), 3, tables.comm);
      const auto numbers = tables.integers(
        table, rows, 0, std::max<hsize_t>(tables.n_cells, 1ull << 32));
      std::vector<StoredPart> result;
      for (std::size_t i = 0; i < numbers.size(); i += 3)
        {
          const std::uint64_t cell   = numbers[i];
          const std::uint64_t number = numbers[i + 1];
          const std::uint64_t id     = numbers[i + 2];
          if (cell >= tables.n_cells || number >= n_in_cell ||
              id >= unnamed_boundary || !named.names.contains(id))
            refuse(
              tables.path,
              fmt::format("table '{}': found number {} of cell {} with the "
                          "name {}, which is not there",
                          table,
                          number,
                          cell,
                          id));
          result.push_back({cell,
                            static_cast<unsigned int>(number),
                            static_cast<unsigned int>(id)});
        }
      return result;
    }

    // Sends named parts to the ranks that have their cells.
    std::vector<CellPart>
    share_out(const std::vector<StoredPart> &stored, const Tables &tables)
    {
      std::map<unsigned int, std::vector<StoredPart>> sent;
      for (const StoredPart &part : stored)
        sent[owner_of_row(part.cell, tables.n_cells, tables.comm)].push_back(
          part);
      std::vector<CellPart> result;
      for (const auto &[rank, parts] : exchange_arrays(sent, tables.comm))
        for (const auto &[cell, number, id] : parts)
          result.push_back(
            {static_cast<unsigned int>(cell - tables.cell_rows.first),
             number,
             id});
      return result;
    }

    // Checks that each list is in the order of the cells, and that no face is
    // listed twice.
    void
    check_order(const MeshPart &part, const std::string &path)
    {
      for (const auto *list : {&part.faces, &part.edges, &part.corners})
        for (std::size_t i = 1; i < list->size(); ++i)
          {
            const CellPart &a = (*list)[i - 1], &b = (*list)[i];
            if (b.cell < a.cell || (list == &part.faces && a.cell == b.cell &&
                                    b.number <= a.number))
              refuse(path, "found names in another order than cells");
          }
    }
  } // namespace

  SpreadMesh
  read_hdf5_mesh(const std::string &path, const MPI_Comm comm)
  {
    SpreadMesh mesh;
    {
      ScopedTimer                               timer(mesh.read_time);
      std::optional<Tables>                     tables;
      std::vector<std::array<std::uint64_t, 4>> cells;
      std::vector<dealii::Point<3>>             own_vertices;
      std::vector<StoredPart>                   faces, edges, corners;
      mesh.origin = path;
      on_all_ranks(comm, [&] {
        // The version is read first: it tells which tables there are.
        read_description(mesh, path);
        tables.emplace(path, comm);
        cells = read_cells(mesh, *tables);
        own_vertices =
          tables->points("vertices", own_rows(tables->n_vertices, 3, comm));
        faces   = read_names("faces", 4, mesh.names.boundaries, *tables);
        edges   = read_names("edges", 6, mesh.names.edges, *tables);
        corners = read_names("corners", 4, mesh.names.corners, *tables);
      });
      fetch_vertices(mesh.part, cells, own_vertices, *tables);
      mesh.part.faces   = share_out(faces, *tables);
      mesh.part.edges   = share_out(edges, *tables);
      mesh.part.corners = share_out(corners, *tables);
      on_all_ranks(comm, [&] {
        check_curves(mesh.part, path);
        check_order(mesh.part, path);
      });
    }
    return mesh;
  }
} // namespace corotet
