// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Meshes in files of MED, written here with MED's own library: two tetrahedra
// with the common face x = 0, groups that overlap, and refusals.

#ifdef COROTET_MED

#  include <gtest/gtest.h>
#  include <med.h>

#  include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  // A mesh, with nodes and numbers as in MED, which count from one.
  struct MedMesh
  {
    struct Block
    {
      med_geometry_type    type;
      int                  n_nodes;
      std::vector<med_int> nodes;
      std::vector<med_int> families;
    };
    std::vector<double>                         coordinates;
    std::vector<med_int>                        families_of_nodes;
    std::vector<Block>                          blocks;
    std::map<med_int, std::vector<std::string>> groups;
    std::vector<std::string>                    names{"part"};
  };

  void
  write_groups(const med_idt file, const std::string &mesh, const MedMesh &med)
  {
    MEDfamilyCr(file, mesh.c_str(), "none", 0, 0, nullptr);
    for (const auto &[family, groups] : med.groups)
      {
        std::string names(groups.size() * MED_LNAME_SIZE + 1, '\0');
        for (std::size_t i = 0; i < groups.size(); ++i)
          names.replace(i * MED_LNAME_SIZE, groups[i].size(), groups[i]);
        MEDfamilyCr(file,
                    mesh.c_str(),
                    ("family " + std::to_string(family)).c_str(),
                    family,
                    med_int(groups.size()),
                    names.c_str());
      }
  }

  std::string
  write_med(const std::string &path, const MedMesh &med)
  {
    const med_idt file = MEDfileOpen(path.c_str(), MED_ACC_CREAT);
    EXPECT_GE(file, 0);
    const std::string axes(3 * MED_SNAME_SIZE, ' ');
    for (const std::string &mesh : med.names)
      {
        const char *name = mesh.c_str();
        MEDmeshCr(file,
                  name,
                  3,
                  3,
                  MED_UNSTRUCTURED_MESH,
                  "",
                  "",
                  MED_SORT_DTIT,
                  MED_CARTESIAN,
                  axes.c_str(),
                  axes.c_str());
        const auto n_nodes = med_int(med.coordinates.size() / 3);
        EXPECT_GE(MEDmeshNodeCoordinateWr(file,
                                          name,
                                          MED_NO_DT,
                                          MED_NO_IT,
                                          0,
                                          MED_FULL_INTERLACE,
                                          n_nodes,
                                          med.coordinates.data()),
                  0);
        if (!med.families_of_nodes.empty())
          MEDmeshEntityFamilyNumberWr(file,
                                      name,
                                      MED_NO_DT,
                                      MED_NO_IT,
                                      MED_NODE,
                                      MED_NONE,
                                      n_nodes,
                                      med.families_of_nodes.data());
        for (const MedMesh::Block &block : med.blocks)
          {
            const med_int n = med_int(block.nodes.size()) / block.n_nodes;
            EXPECT_GE(MEDmeshElementConnectivityWr(file,
                                                   name,
                                                   MED_NO_DT,
                                                   MED_NO_IT,
                                                   0,
                                                   MED_CELL,
                                                   block.type,
                                                   MED_NODAL,
                                                   MED_FULL_INTERLACE,
                                                   n,
                                                   block.nodes.data()),
                      0);
            if (!block.families.empty())
              MEDmeshEntityFamilyNumberWr(file,
                                          name,
                                          MED_NO_DT,
                                          MED_NO_IT,
                                          MED_CELL,
                                          block.type,
                                          n,
                                          block.families.data());
          }
        write_groups(file, mesh, med);
      }
    EXPECT_GE(MEDfileClose(file), 0);
    return path;
  }

  // Two tetrahedra of volumes 1/6 and 1/3. Their common face x = 0 has the
  // nodes 1, 2, 3; the tips 4 and 5 are at x = 1 and x = -2. Seen from the tip,
  // MED's nodes 1, 2, 3 of a tetrahedron go round the other way than gmsh's.
  MedMesh
  two_tetrahedra()
  {
    MedMesh med;
    med.coordinates = {0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, -2, 0, 0};
    med.blocks      = {{MED_TETRA4, 4, {1, 3, 2, 4, 1, 2, 3, 5}, {-1, -2}},
                       {MED_TRIA3, 3, {1, 2, 4, 1, 3, 4, 1, 2, 5}, {-3, -4, 0}},
                       {MED_SEG2, 2, {1, 4}, {-5}}};
    med.families_of_nodes = {0, 0, 0, 2, 3};
    med.groups            = {{-1, {"short", "all"}},
                             {-2, {"long", "all"}},
                             {-3, {"wall"}},
                             {-4, {"wall", "side"}},
                             {-5, {"axis"}},
                             {2, {"tips"}},
                             {3, {"tips", "the far tip"}}};
    return med;
  }

  // The same tetrahedra with nodes in the middles of edges, in MED's order:
  // between the nodes 1-2, 2-3, 3-1, 1-4, 2-4, 3-4 of each cell.
  MedMesh
  two_quadratic_tetrahedra()
  {
    MedMesh med     = two_tetrahedra();
    med.coordinates = {0, 0,  0,  0,  1, 0,  0,  0, 1,  1, 0,  0,  -2, 0,
                       0, 0,  0,  .5, 0, .5, .5, 0, .5, 0, .5, 0,  0,  .5,
                       0, .5, .5, .5, 0, -1, 0,  0, -1, 0, .5, -1, .5, 0};
    // Nodes and their edges: 6: 1-3, 7: 2-3, 8: 1-2, 9: 1-4, 10: 3-4, 11: 2-4,
    // 12: 1-5, 13: 3-5, 14: 2-5.
    med.blocks = {{MED_TETRA10,
                   10,
                   {1, 3, 2, 4, 6, 7, 8, 9,  10, 11,
                    1, 2, 3, 5, 8, 7, 6, 12, 14, 13},
                   {-1, -2}},
                  {MED_TRIA6, 6, {1, 2, 4, 8, 11, 9}, {-3}}};
    med.families_of_nodes.clear();
    return med;
  }

  std::string
  refusal_of(const std::string &path)
  {
    const std::string message = refusal([&] { read_file(path); });
    EXPECT_EQ(message.compare(0, path.size() + 7, path + ": gmsh:"), 0)
      << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message.substr(std::min(message.size(), path.size() + 8));
  }
} // namespace

TEST(MedFile, Names)
{
  const TemporaryFolder folder;
  const SerialMesh      mesh =
    read_file(write_med(folder / "two.med", two_tetrahedra()));
  ASSERT_EQ(mesh.cells.size(), 2);
  EXPECT_NEAR(volume(mesh, "short"), 1 / 6., 1e-15);
  EXPECT_NEAR(volume(mesh, "long"), 1 / 3., 1e-15);
  EXPECT_NEAR(volume(mesh, "all"), 1 / 2., 1e-15);
  EXPECT_NEAR(area(mesh, "wall"), 1, 1e-15);
  EXPECT_NEAR(area(mesh, "side"), 0.5, 1e-15);
  EXPECT_EQ(mesh.edges.size(), 1);
  // A corner counts once for each of its names.
  EXPECT_EQ(mesh.corners.size(), 3);
}

// A file of MED is recognised by its content, whatever its name is.
TEST(MedFile, AnyName)
{
  const TemporaryFolder folder;
  write_med(folder / "two.med", two_tetrahedra());
  std::filesystem::rename(folder / "two.med", folder / "two.part");
  EXPECT_NEAR(total(region_volumes(read_file(folder / "two.part"))),
              0.5,
              1e-15);
}

// Some programs order the nodes of tetrahedra as most other formats do.
TEST(MedFile, OtherOrientation)
{
  const TemporaryFolder folder;
  MedMesh               med = two_tetrahedra();
  med.blocks[0].nodes       = {1, 2, 3, 4, 1, 3, 2, 5};
  EXPECT_NEAR(volume(read_file(write_med(folder / "other.med", med)), "all"),
              0.5,
              1e-15);
  med                   = two_quadratic_tetrahedra();
  med.blocks[0].nodes   = {1, 2, 3, 4, 8, 7, 6, 9,  11, 10,
                           1, 3, 2, 5, 6, 7, 8, 12, 13, 14};
  const SerialMesh mesh = read_file(write_med(folder / "other2.med", med));
  EXPECT_NEAR(volume(mesh, "all"), 0.5, 1e-15);
  EXPECT_TRUE(mesh.curved_nodes.empty());
}

// Cells with nodes in the middles of straight edges are straight; if the order
// were another one, the nodes would not be in the middles.
TEST(MedFile, QuadraticCells)
{
  const TemporaryFolder folder;
  MedMesh               med  = two_quadratic_tetrahedra();
  const SerialMesh      mesh = read_file(write_med(folder / "two.med", med));
  EXPECT_NEAR(volume(mesh, "all"), 0.5, 1e-15);
  EXPECT_NEAR(area(mesh, "wall"), 0.5, 1e-15);
  EXPECT_TRUE(mesh.curved_nodes.empty());
  // Node 11 lies between 2 and 4.
  med.coordinates[3 * 10 + 1] += 0.01;
  EXPECT_EQ(read_file(write_med(folder / "bent.med", med)).curved_nodes.size(),
            10);
}

TEST(MedFile, Refused)
{
  const TemporaryFolder folder;
  MedMesh               med = two_tetrahedra();
  med.names                 = {"a", "b"};
  EXPECT_EQ(refusal_of(write_med(folder / "meshes.med", med)),
            "MED: found 2 meshes; allowed is a file with one");
  med                    = two_tetrahedra();
  med.blocks[0].nodes[2] = 9;
  EXPECT_EQ(refusal_of(write_med(folder / "node.med", med)),
            "MED: an element has the node 9 of 5");
  med = two_tetrahedra();
  med.blocks.push_back({MED_PYRA5, 5, {1, 2, 3, 4, 5}, {}});
  const std::string mixed   = write_med(folder / "mixed.med", med);
  const std::string message = refusal([&] { read_file(mixed); });
  EXPECT_NE(message.find("found 1 of the type 'Pyramid 5'"), std::string::npos)
    << message;
}

// A file that is cut off anywhere is refused, not read as a smaller mesh.
TEST(MedFile, CutOff)
{
  const TemporaryFolder folder;
  write_med(folder / "whole.med", two_tetrahedra());
  const std::string bytes = folder.read("whole.med");
  for (const double part : {0.01, 0.1, 0.5, 0.9, 0.99})
    refusal_of(folder.write("cut.med",
                            bytes.substr(0, std::size_t(part * bytes.size()))));
}

#endif
