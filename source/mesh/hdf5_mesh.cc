// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/hdf5_file.h>
#include <corotet/mesh/facets.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/local_mesh.h>

#include <nlohmann/json.hpp>

#include "hdf5_mesh_description.h"

namespace corotet
{
  using namespace hdf5_mesh;

  namespace
  {
    using nlohmann::json;

    // The attribute that marks a file as a mesh.
    constexpr const char *mark_of_mesh = "corotet_mesh";

  } // namespace



  SerialMesh
  read_hdf5_mesh(const std::string &path)
  {
    SpreadMesh read   = read_hdf5_mesh(path, MPI_COMM_SELF);
    SerialMesh mesh   = serial_mesh(std::move(read.part));
    mesh.regions      = std::move(read.names.regions);
    mesh.boundaries   = std::move(read.names.boundaries);
    mesh.edge_names   = std::move(read.names.edges);
    mesh.corner_names = std::move(read.names.corners);
    mesh.origin       = path;
    mesh.remarks      = std::move(read.remarks);
    mesh.faceted      = std::move(read.faceted);
    return mesh;
  }



  bool
  is_hdf5_mesh(const std::string &path)
  {
    const Hdf5Silence silence;
    const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, unlocked_access()));
    return file >= 0 && H5Aexists(file, mark_of_mesh) > 0;
  }



  void
  write_hdf5_mesh(const std::string &path, const SerialMesh &mesh)
  {
    const LocalMesh local = distribute(mesh, MPI_COMM_SELF);
    const auto      table = [&](const std::vector<CellPart> &list) {
      std::vector<std::int64_t> numbers;
      for (const auto &[cell, number, id] : list)
        numbers.insert(numbers.end(), {cell, number, id});
      return numbers;
    };
    const auto coordinates = [](const std::vector<dealii::Point<3>> &points) {
      std::vector<double> numbers;
      for (const dealii::Point<3> &x : points)
        numbers.insert(numbers.end(), {x[0], x[1], x[2]});
      return numbers;
    };
    std::vector<std::int64_t> cells, regions, curves;
    for (const MeshCells::Cell &cell : local.cells)
      {
        cells.insert(cells.end(), cell.vertices.begin(), cell.vertices.end());
        regions.push_back(cell.region);
        curves.push_back(cell.curve == MeshCells::straight ?
                           -1 :
                           static_cast<std::int64_t>(cell.curve));
      }
    const UsedNames        names(mesh);
    std::set<unsigned int> faceted = mesh.faceted;
    std::erase_if(faceted, [&](const unsigned int id) {
      return id != no_boundary && !names.boundaries.names.contains(id);
    });
    std::string text;
    try
      {
        text = json{{"corotet mesh", hdf5_mesh::version},
                    {"geometry degree", local.geometry_degree},
                    {"regions", to_json(names.regions)},
                    {"boundaries", to_json(names.boundaries)},
                    {"edges", to_json(names.edges)},
                    {"corners", to_json(names.corners)},
                    {"faceted", faceted}}
                 .dump();
      }
    catch (const json::type_error &)
      {
        throw InputError("",
                         path + ": names are written in UTF-8: found a name "
                                "with other letters; a .msh file keeps it");
      }
    Hdf5File file(path, MPI_COMM_SELF);
    file.write_number_attribute("/", mark_of_mesh, {hdf5_mesh::version});
    file.write_from_root("description",
                         std::vector<std::uint8_t>(text.begin(), text.end()));
    file.write_from_root("vertices", coordinates(local.vertices), 3);
    file.write_from_root("cells", cells, 4);
    file.write_from_root("regions", regions);
    file.write_from_root("curves", curves);
    file.write_from_root("curved_nodes", coordinates(local.curved_nodes), 3);
    file.write_from_root("faces", table(local.faces), 3);
    file.write_from_root("edges", table(local.edges), 3);
    file.write_from_root("corners", table(local.corners), 3);
    file.finish(true);
  }
} // namespace corotet
