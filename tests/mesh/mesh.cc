// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The distributed mesh: sums over all ranks are those of the whole body,
// whatever the number of ranks.

#include <corotet/base/exceptions.h>
#include <corotet/base/memory.h>
#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/mesh.h>
#include <corotet/mesh/refinement.h>

#include <deal.II/base/mpi.h>

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const MPI_Comm comm = MPI_COMM_WORLD;

  Mesh
  make_mesh(const SerialMesh  &mesh,
            const unsigned int n_refinements = 0,
            const double       scale         = 1)
  {
    Log log(comm, true);
    return {mesh, n_refinements, scale, comm, log};
  }

  template <typename Value>
  Value
  sum(const Value &value)
  {
    return dealii::Utilities::MPI::sum(value, comm);
  }

  double
  volume(const Mesh &mesh, const unsigned int region)
  {
    double local = 0;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned() && cell->material_id() == region)
        local += cell->measure();
    return sum(local);
  }

  double
  area(const Mesh &mesh, const unsigned int boundary)
  {
    double local = 0;
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && face->boundary_id() == boundary)
            local += face->measure();
    return sum(local);
  }

  // Checks a mesh of the box of 2 x 0.5 x 1 times @p scale.
  void
  expect_box(const Mesh &mesh, const unsigned int n_cells, const double scale)
  {
    EXPECT_EQ(mesh.triangulation().n_global_active_cells(), n_cells);
    EXPECT_EQ(mesh.triangulation().n_global_levels(), 1u);
    EXPECT_GT(mesh.triangulation().n_locally_owned_active_cells(), 0u);
    for (const auto &cell : mesh.triangulation().active_cell_iterators())
      EXPECT_GT(cell->measure(), 0);

    // The round-off of sums of some thousand terms.
    EXPECT_NEAR(volume(mesh, 0) / std::pow(scale, 3), 1, 1e-12);
    const double expected[6] = {0.5, 0.5, 2, 2, 1, 1};
    for (unsigned int b = 0; b < 6; ++b)
      EXPECT_NEAR(area(mesh, b) / std::pow(scale, 2), expected[b], 1e-12);
    EXPECT_EQ(area(mesh, unnamed_boundary), 0);
  }
} // namespace

TEST(Mesh, Distribution)
{
  expect_box(make_mesh(box_of_2_by_half_by_1("8, 2, 4")), 5 * 8 * 2 * 4, 1);
}

// Ranks have equal numbers of cells, up to one cell.
TEST(Mesh, Balance)
{
  const Mesh   mesh    = make_mesh(box_of_2_by_half_by_1("8, 2, 4"));
  const double n_cells = mesh.triangulation().n_locally_owned_active_cells();
  const double average = 320. / dealii::Utilities::MPI::n_mpi_processes(comm);
  EXPECT_NEAR(n_cells, average, 1);
}

// Every refinement cuts each cell into eight that fill it; the scale multiplies
// lengths.
TEST(Mesh, RefinementAndScale)
{
  expect_box(make_mesh(box_of_2_by_half_by_1("2, 1, 1"), 1), 10 * 8, 1);
  expect_box(make_mesh(box_of_2_by_half_by_1("2, 1, 1"), 2), 10 * 64, 1);
  expect_box(make_mesh(box_of_2_by_half_by_1("2, 1, 1"), 2, 0.001),
             10 * 64,
             0.001);
}

// A rank may have no cell before the refinement.
TEST(Mesh, RefinementOfOneCell)
{
  SerialMesh mesh = box_of_2_by_half_by_1("1, 1, 1");
  mesh.cells.resize(1);
  mesh.faces.clear();
  EXPECT_NEAR(volume(make_mesh(mesh, 1), 0), 1. / 6, 1e-15);
}

// A refined mesh is as good as one that was read: it passes the same checks.
TEST(Mesh, RefinedMeshIsConforming)
{
  SerialMesh mesh = box_of_2_by_half_by_1("2, 1, 1");
  refine_uniformly(mesh, 2);
  check_mesh(mesh);
  EXPECT_EQ(mesh.cells.size(), 640u);
  EXPECT_EQ(boundary_areas(mesh).size(), 6u);
}

// The surface that belongs to no boundary has an id of its own, though deal.II
// would give it the one of x-min; no name selects it. Regions are kept.
TEST(Mesh, RegionsAndUnnamedSurface)
{
  SerialMesh mesh = box_of_2_by_half_by_1("4, 1, 2");
  std::erase_if(mesh.faces,
                [](const auto &face) { return face.boundary != 3; });
  for (SerialMesh::Cell &cell : mesh.cells)
    {
      double x = 0;
      for (const unsigned int v : cell.vertices)
        x += mesh.vertices[v][0] / 4;
      cell.region = x < 1 ? 5 : 6;
    }
  mesh.regions.names     = {{5, "left"}, {8, "not in the mesh"}};
  const Mesh distributed = make_mesh(mesh, 1);
  EXPECT_NEAR(volume(distributed, 5), 0.5, 1e-13);
  EXPECT_NEAR(volume(distributed, 6), 0.5, 1e-13);
  EXPECT_NEAR(area(distributed, 3), 2, 1e-13);
  EXPECT_EQ(area(distributed, 0), 0);
  EXPECT_NEAR(area(distributed, unnamed_boundary), 5, 1e-13);

  using Names = std::map<unsigned int, std::string>;
  EXPECT_EQ(distributed.regions().all(), (Names{{5, "left"}, {6, ""}}));
  EXPECT_EQ(distributed.boundaries().all(), (Names{{3, "y-max"}}));
}

// No rank has a face that claims to be on a side of the box where it is not,
// not even a face of a ghost cell.
TEST(Mesh, GhostFacesAreNoSurface)
{
  const Mesh   mesh     = make_mesh(box_of_2_by_half_by_1("8, 2, 4"));
  const double place[6] = {0, 2, 0, 0.5, 0, 1};
  for (const auto &cell : mesh.triangulation().active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary() && face->boundary_id() != unnamed_boundary)
        {
          const unsigned int b = face->boundary_id();
          ASSERT_LT(b, 6u);
          EXPECT_NEAR(face->center()[b / 2], place[b], 1e-15);
        }
}

// Most consecutive cells are neighbours: the mean distance of their centres is
// below the edge of a cuboid, 0.125. (In the order of creation it is about as
// small, but in a random order 0.9: the shuffled input shows that the curve
// does it. On several ranks there are a few more jumps.)
TEST(Mesh, OrderAlongCurve)
{
  SerialMesh mesh = box_of_2_by_half_by_1("16, 4, 8");
  // A fixed permutation: 1009 has no divisor in common with 5 * 16 * 4 * 8.
  std::vector<SerialMesh::Cell> shuffled;
  for (std::size_t i = 0; i < mesh.cells.size(); ++i)
    shuffled.push_back(mesh.cells[i * 1009 % mesh.cells.size()]);
  mesh.cells = shuffled;

  const Mesh                    distributed = make_mesh(mesh);
  std::vector<dealii::Point<3>> centres;
  for (const auto &cell : distributed.triangulation().active_cell_iterators())
    if (cell->is_locally_owned())
      centres.push_back(cell->center());
  double length = 0;
  for (std::size_t i = 1; i < centres.size(); ++i)
    length += centres[i].distance(centres[i - 1]);
  EXPECT_LT(length / centres.size(), 0.125);
}

// A mesh is made from parameters, and the log tells about it. The 2 x 2 x 2
// cubes have 27 vertices, 54 edges, and 36 squares with one diagonal each; a
// refinement adds the middle of every edge and diagonal.
TEST(Mesh, FromParameters)
{
  MeshParameters           parameters;
  dealii::ParameterHandler prm;
  parameters.declare_parameters(prm);
  std::istringstream text("set Type = box\nset Refinements = 1\n"
                          "set Scale = 0.5\n"
                          "subsection box\nset Origin = 1, 1, 1\n"
                          "set Size = 2, 2, 2\nset Cells = 2, 2, 2\nend\n");
  prm.parse_input(text);

  const TemporaryFolder folder;
  const std::string     log_file = folder / "log.txt";
  {
    Log log(comm, true);
    log.open(log_file);
    const auto start = std::chrono::steady_clock::now();
    const Mesh mesh(parameters, "", comm, log);
    const std::chrono::duration<double> whole =
      std::chrono::steady_clock::now() - start;
    // Rank 0 reads the mesh for all.
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        EXPECT_GT(mesh.read_time(), 0);
      }
    EXPECT_LE(mesh.read_time(), whole.count());
    EXPECT_EQ(mesh.triangulation().n_global_active_cells(), 320u);
    EXPECT_NEAR(volume(mesh, 0), 1, 1e-13);
  }
  if (dealii::Utilities::MPI::this_mpi_process(comm) != 0)
    return;
  std::stringstream log;
  log << std::ifstream(log_file).rdbuf();
  EXPECT_NE(log.str().find("Mesh: 320 cells, 117 vertices, volume 1 m^3"),
            std::string::npos)
    << log.str();
  EXPECT_NE(log.str().find("regions: body; boundaries: x-min, x-max, y-min, "
                           "y-max, z-min, z-max"),
            std::string::npos)
    << log.str();
}

// A refusal on rank 0 reaches every rank; no rank waits for ever.
TEST(Mesh, RefusalsReachEveryRank)
{
  SerialMesh inverted = box_of_2_by_half_by_1("1, 1, 1");
  std::swap(inverted.cells[3].vertices[0], inverted.cells[3].vertices[1]);
  EXPECT_NE(refusal([&] { make_mesh(inverted); }).find("(inverted)"),
            std::string::npos);

  EXPECT_EQ(refusal([&] { make_mesh(box_of_2_by_half_by_1("1, 1, 1"), 9); }),
            "Mesh/Refinements: too many cells: found 9 refinements, which "
            "make 6.71e+08 cells of 5; at most 3e+08 are allowed");

  // A mesh that does not fit into the memory is refused before anything is
  // made. With several ranks the test cannot tell, as they may be on several
  // machines.
  if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1 &&
      available_memory() < 4e11)
    {
      std::string said;
      try
        {
          make_mesh(box_of_2_by_half_by_1("12, 12, 12"), 5);
        }
      catch (const MachineError &error)
        {
          said = error.what();
        }
      EXPECT_NE(said.find("2.831e+08 cells of degree 3 would need at least"),
                std::string::npos)
        << said;
    }

  MeshParameters           parameters;
  dealii::ParameterHandler prm;
  parameters.declare_parameters(prm);
  std::istringstream text("set Type = gmsh\n"
                          "subsection gmsh\nset File = missing.msh\nend\n");
  prm.parse_input(text);
  Log log(comm, true);
  EXPECT_EQ(refusal([&] { Mesh(parameters, "/nowhere", comm, log); }),
            "Mesh/gmsh/File: there is no mesh file: found "
            "'/nowhere/missing.msh'");
}

TEST(Mesh, FewerCellsThanRanks)
{
  SerialMesh mesh;
  mesh.vertices              = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.cells                 = {{{{0, 1, 2, 3}}, 0}};
  const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(comm);
  EXPECT_EQ(refusal([&] { make_mesh(mesh); }),
            n_ranks == 1 ?
              "nothing was refused" :
              "Mesh/Type: too few cells: found 1 for " +
                std::to_string(n_ranks) + " ranks; each needs at least one");
}

// A text is looked up as a name first, then as an id; messages about unknown
// names list the known ones.
TEST(MeshNames, Lookup)
{
  using Ids = std::vector<unsigned int>;
  const MeshNames names("boundary",
                        {{{0, "x-min"}, {1, "x-max"}, {4, ""}, {6, "5"}}, {}});
  EXPECT_EQ(names.ids("x-max", ""), Ids{1});
  EXPECT_EQ(names.ids("0", ""), Ids{0});
  EXPECT_EQ(names.ids("4", ""), Ids{4});
  EXPECT_EQ(names.ids("5", ""), Ids{6});
  EXPECT_EQ(names.name(1), "x-max");
  EXPECT_EQ(names.name(4), "4");

  EXPECT_EQ(refusal([&] { names.ids("x-mx", "Loads/Boundary"); }),
            "Loads/Boundary: no such boundary: found 'x-mx'; the mesh has the "
            "boundaries: x-min, x-max, 4, 5; did you mean 'x-max'?");
  EXPECT_EQ(refusal([&] { names.ids("elsewhere", "Loads/Boundary"); }),
            "Loads/Boundary: no such boundary: found 'elsewhere'; the mesh has "
            "the boundaries: x-min, x-max, 4, 5");
  EXPECT_EQ(refusal(
              [] { MeshNames("region", {}).ids("a", "Material/Region"); }),
            "Material/Region: no such region: found 'a'; the mesh has no "
            "regions");
}

namespace
{
  // The box above, stretched to a given height by a source of meshes.
  class Stretched : public MeshSource
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      prm.add_parameter("Height", height);
    }

    SerialMesh
    create(const std::string &, const unsigned int) const override
    {
      SerialMesh mesh = box_of_2_by_half_by_1("4, 1, 2");
      for (auto &vertex : mesh.vertices)
        vertex[2] *= height;
      return mesh;
    }

  private:
    double height = 1;
  };
} // namespace

// A mesh source that a program adds can be selected like those of the library.
TEST(Mesh, FromASourceOfAnotherProgram)
{
  const AddedCandidate<MeshSource> stretched(
    candidate<MeshSource, Stretched>("stretched"));
  MeshParameters           parameters;
  dealii::ParameterHandler prm;
  parameters.declare_parameters(prm);
  prm.parse_input_from_string(
    "set Type = stretched\nsubsection stretched\nset Height = 3\nend\n");
  Log        log(comm, true);
  const Mesh mesh(parameters, "", comm, log);
  EXPECT_NEAR(volume(mesh, 0), 2 * 0.5 * 3, 1e-13);
}
