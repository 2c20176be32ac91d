// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Meshes that all ranks read together: each rank has what it would have got
// from rank 0, and damaged files are refused by all of them.

#include <corotet/mesh/curved_cells.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>
#include <hdf5.h>
#include <nlohmann/json.hpp>

#include <limits>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // One folder for all ranks, made and removed by rank 0.
  class SharedFolder
  {
  public:
    SharedFolder()
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        folder.emplace();
      name = dealii::Utilities::MPI::broadcast(MPI_COMM_WORLD,
                                               folder ? *folder / "" : "");
    }

    ~SharedFolder()
    {
      MPI_Barrier(MPI_COMM_WORLD);
    }

    SharedFolder(const SharedFolder &) = delete;
    SharedFolder &
    operator=(const SharedFolder &) = delete;

    // Lets rank 0 write the file.
    std::string
    write(const std::string &file, const SerialMesh &mesh) const
    {
      if (folder)
        write_hdf5_mesh(name + file, mesh);
      MPI_Barrier(MPI_COMM_WORLD);
      return name + file;
    }

    std::optional<TemporaryFolder> folder;
    std::string                    name;
  };

  // A box with named regions, boundaries, edges and corners, and some curved
  // cells.
  SerialMesh
  body_with_everything()
  {
    SerialMesh mesh = box_of_2_by_half_by_1("5, 2, 3");
    for (unsigned int c = 0; c < mesh.cells.size(); ++c)
      mesh.cells[c].region = c % 3;
    mesh.regions.names      = {{0, "first"}, {1, ""}, {2, "last"}};
    mesh.regions.sets       = {{"both", {0, 2}}};
    mesh.edge_names.names   = {{0, "an edge"}, {4, ""}};
    mesh.corner_names.names = {{1, "tip"}};
    for (const unsigned int c : {3u, 50u, 100u})
      {
        const auto &v = mesh.cells[c].vertices;
        mesh.edges.push_back({{{v[0], v[2]}}, 0});
        mesh.edges.push_back({{{v[3], v[1]}}, 4});
        mesh.corners.push_back({v[1], 1});
      }
    mesh.geometry_degree = 2;
    for (unsigned int c = 0; c < mesh.cells.size(); c += 7)
      {
        const auto corners  = cell_vertices(mesh, mesh.cells[c]);
        mesh.cells[c].curve = mesh.curved_nodes.size() / 10;
        for (const dealii::Point<3> &xi : map_points(2))
          {
            dealii::Point<3> x = corners[0];
            for (unsigned int k = 0; k < 3; ++k)
              x += xi[k] * (corners[k + 1] - corners[0]);
            mesh.curved_nodes.push_back(x);
          }
        mesh.curved_nodes.back()[0] += 0.001;
      }
    check_mesh(mesh);
    return mesh;
  }

  Mesh
  read(const std::string &file, const unsigned int n_refinements = 0)
  {
    MeshParameters           parameters;
    dealii::ParameterHandler prm;
    prm.enter_subsection("Mesh");
    parameters.declare_parameters(prm);
    prm.set("Type", "file");
    prm.set("Refinements", static_cast<long int>(n_refinements));
    prm.enter_subsection("file");
    prm.set("File", file);
    prm.leave_subsection();
    prm.leave_subsection();
    Log log(MPI_COMM_WORLD, true);
    return {parameters, "", MPI_COMM_WORLD, log};
  }

  void
  expect_equal(const std::vector<CellPart> &a, const std::vector<CellPart> &b)
  {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        EXPECT_EQ(a[i].cell, b[i].cell);
        EXPECT_EQ(a[i].number, b[i].number);
        EXPECT_EQ(a[i].id, b[i].id);
      }
  }
} // namespace

TEST(Hdf5Mesh, EachRankHasItsPart)
{
  const SharedFolder folder;
  const SerialMesh   whole = body_with_everything();
  const std::string  file  = folder.write("body.h5", whole);
  for (const unsigned int n_refinements : {0u, 1u})
    {
      Log              log(MPI_COMM_WORLD, true);
      const Mesh       expected(whole, n_refinements, 1., MPI_COMM_WORLD, log);
      const Mesh       mesh = read(file, n_refinements);
      const LocalMesh &a = mesh.local(), &b = expected.local();
      EXPECT_EQ(a.numbers, b.numbers);
      EXPECT_EQ(a.owners, b.owners);
      EXPECT_EQ(a.vertices, b.vertices);
      EXPECT_EQ(a.vertex_numbers, b.vertex_numbers);
      EXPECT_EQ(a.neighbors, b.neighbors);
      EXPECT_EQ(a.curved_nodes, b.curved_nodes);
      EXPECT_EQ(a.geometry_degree, 2u);
      ASSERT_EQ(a.cells.size(), b.cells.size());
      for (unsigned int c = 0; c < a.cells.size(); ++c)
        {
          EXPECT_EQ(a.cells[c].vertices, b.cells[c].vertices);
          EXPECT_EQ(a.cells[c].region, b.cells[c].region);
          EXPECT_EQ(a.cells[c].curve, b.cells[c].curve);
        }
      expect_equal(a.faces, b.faces);
      expect_equal(a.edges, b.edges);
      expect_equal(a.corners, b.corners);
      EXPECT_EQ(mesh.regions().known(), expected.regions().known());
      EXPECT_EQ(mesh.places().edges.known(), expected.places().edges.known());
    }
}

namespace
{
  // Changes one number of a table.
  template <typename Number>
  void
  change(const std::string &file,
         const std::string &table,
         const std::size_t  place,
         const Number       value,
         const hid_t        type)
  {
    const hid_t         id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    const hid_t         dataset = H5Dopen2(id, table.c_str(), H5P_DEFAULT);
    const hid_t         space   = H5Dget_space(dataset);
    std::vector<Number> numbers(H5Sget_simple_extent_npoints(space));
    H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    numbers.at(place) = value;
    H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data());
    H5Sclose(space);
    H5Dclose(dataset);
    H5Fclose(id);
  }
} // namespace

// A set with an id that does not exist, and a name with a reserved id.
TEST(Hdf5Mesh, WrongIds)
{
  using nlohmann::json;
  const SharedFolder folder;
  const auto         refused = [&](const std::function<void(json &)> &edit) {
    const std::string file = folder.write("body.h5", body_with_everything());
    if (folder.folder)
      {
        const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        hid_t       data  = H5Dopen2(id, "description", H5P_DEFAULT);
        hid_t       space = H5Dget_space(data);
        std::string text(H5Sget_simple_extent_npoints(space), ' ');
        H5Dread(
          data, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
        H5Sclose(space);
        H5Dclose(data);
        json description = json::parse(text);
        edit(description);
        text            = description.dump();
        const hsize_t n = text.size();
        H5Ldelete(id, "description", H5P_DEFAULT);
        space = H5Screate_simple(1, &n, nullptr);
        data  = H5Dcreate2(id,
                          "description",
                          H5T_STD_U8LE,
                          space,
                          H5P_DEFAULT,
                          H5P_DEFAULT,
                          H5P_DEFAULT);
        H5Dwrite(
          data, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data());
        H5Sclose(space);
        H5Dclose(data);
        H5Fclose(id);
      }
    MPI_Barrier(MPI_COMM_WORLD);
    return refusal([&] { read(file); });
  };
  const auto expect = [&](const std::string                 &words,
                          const std::function<void(json &)> &edit) {
    const std::string found = refused(edit);
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  EXPECT_EQ(refused([](json &) {}), "nothing was refused");
  expect("found the id 77 in the set 'gone', which is not there",
         [](json &text) { text["boundaries"]["sets"]["gone"] = {77}; });
  expect("found the id 4294967294 of a name; 0 to 4294967293 are allowed",
         [](json &text) {
           text["regions"]["names"].push_back({4294967294u, "last"});
         });
}

TEST(Hdf5Mesh, DamagedFiles)
{
  const SharedFolder folder;
  const SerialMesh   whole = body_with_everything();
  const auto refused       = [&](const std::function<void(std::string)> &damage,
                           const std::string                      &words) {
    const std::string file = folder.write("body.h5", whole);
    if (folder.folder)
      damage(file);
    MPI_Barrier(MPI_COMM_WORLD);
    const std::string found = refusal([&] { read(file); });
    EXPECT_NE(found.find(file), std::string::npos) << found;
    EXPECT_NE(found.find(words), std::string::npos) << found;
  };
  const auto integer = [](const std::string &table,
                          const std::size_t  place,
                          const std::int64_t value) {
    return [=](const std::string &file) {
      change(file, table, place, value, H5T_NATIVE_INT64);
    };
  };
  refused(integer("cells", 401, 1000),
          "table 'cells': found the number 1000; 0 to 71 are allowed");
  refused(integer("cells", 3, -5), "found the number -5");
  refused(integer("regions", 140, 9), "found the region 9, which has no name");
  refused(integer("curves", 7, 2), "found curved cells in another order");
  refused(integer("faces", 1, 4), "found number 4 of cell");
  refused(integer("faces", 2, 77), "with the name 77, which is not there");
  refused(integer("edges", 0, 150), "found number");
  refused(integer("faces", 0, 140), "found names in another order than cells");
  refused(
    [](const std::string &file) {
      change(file, "curved_nodes", 3, 0.3, H5T_NATIVE_DOUBLE);
    },
    "the first four nodes must be the vertices");
  refused(
    [](const std::string &file) {
      // The text begins with the boundaries; the version number follows its
      // key.
      std::string text;
      const hid_t id      = H5Fopen(file.c_str(), H5F_ACC_RDWR, 0);
      const hid_t dataset = H5Dopen2(id, "description", H5P_DEFAULT);
      const hid_t space   = H5Dget_space(dataset);
      std::vector<std::uint8_t> bytes(H5Sget_simple_extent_npoints(space));
      H5Dread(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, 0, bytes.data());
      text.assign(bytes.begin(), bytes.end());
      const std::string key                 = "\"corotet mesh\":";
      bytes.at(text.find(key) + key.size()) = '2';
      H5Dwrite(dataset, H5T_NATIVE_UINT8, H5S_ALL, H5S_ALL, 0, bytes.data());
      H5Ldelete(id, "curves", H5P_DEFAULT);
      H5Sclose(space);
      H5Dclose(dataset);
      H5Fclose(id);
    },
    "found version 2 of corotet's mesh files; 1 is allowed");
  refused(
    [](const std::string &file) {
      change(file,
             "vertices",
             100,
             std::numeric_limits<double>::infinity(),
             H5T_NATIVE_DOUBLE);
    },
    "table 'vertices': found the coordinates");
  refused(
    [](const std::string &file) {
      change(file, "description", 0, std::uint8_t('x'), H5T_NATIVE_UINT8);
    },
    "table 'description'");
  for (const std::string table :
       {"cells", "vertices", "regions", "faces", "description"})
    refused(
      [&](const std::string &file) {
        const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
        H5Ldelete(id, table.c_str(), H5P_DEFAULT);
        H5Fclose(id);
      },
      "table '" + table + "': there is none");
}

// A boundary face inside of the body, which the file should not have.
TEST(Hdf5Mesh, FaceInside)
{
  const SharedFolder folder;
  SerialMesh         whole = box_of_2_by_half_by_1("2, 1, 1");
  const auto        &v     = whole.cells[4].vertices;
  // The cell in the middle of a cuboid has no face on the surface.
  whole.faces.push_back({{{v[0], v[1], v[2]}}, 0});
  const std::string found =
    refusal([&] { read(folder.write("body.h5", whole)); });
  EXPECT_NE(found.find("inside of the body"), std::string::npos) << found;
}
