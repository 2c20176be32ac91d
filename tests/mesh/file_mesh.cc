// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Files of other programs: their formats are told by their content, whatever
// their names are, and their meshes are the bodies that they describe.

#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/mesh_format.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  using Known = std::vector<std::string>;

  void
  move(const std::string &from, const std::string &to)
  {
    std::filesystem::rename(from, to);
  }
} // namespace

// A box of 1 x 2 x 3 in each format of CAD programs. Its sides are plane, so
// volume and area are exact to the digits that the file has.
TEST(FileMesh, Solids)
{
  const TemporaryFolder folder;
  for (const std::string extension : {"step", "brep", "iges"})
    {
      const std::string file = folder / ("box." + extension);
      write_shapes(file, [] { gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3); });
      EXPECT_EQ(mesh_format(file, "").name, extension);
      const std::string other = folder / ("a part." + extension + ".dat");
      move(file, other);
      const SerialMesh mesh = read_file(other);
      EXPECT_NEAR(total(region_volumes(mesh)), 6, 1e-6) << extension;
      const auto areas = boundary_areas(mesh);
      EXPECT_EQ(areas.size(), 6u) << extension;
      EXPECT_NEAR(total(areas), 22, 1e-6) << extension;
      // gmsh writes each surface of an IGES file separately.
      const Known sewn = {"surfaces are sewn to solids, with gaps of less than "
                          "3.7e-08 between their edges"};
      EXPECT_EQ(mesh.remarks, extension == "iges" ? sewn : Known())
        << extension;
      // By default, edges are no longer than about a twentieth of the diagonal.
      EXPECT_GT(mesh.cells.size(), 1000u) << extension;
      EXPECT_LT(read_file(other, "1").cells.size(), 200u) << extension;
    }
}

// Solids that touch share faces where they do: there is one body with a region
// for each solid. The surfaces between them are no boundaries.
TEST(FileMesh, SolidsThatTouch)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "two.step";
  write_shapes(file, [] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    gmsh::model::occ::addBox(1, 0.25, 0.25, 1, 0.5, 0.5);
  });
  const SerialMesh mesh    = read_file(file, "0.3");
  const auto       volumes = region_volumes(mesh);
  ASSERT_EQ(volumes.size(), 2u);
  EXPECT_NEAR(volumes.begin()->second, 1, 1e-12);
  EXPECT_NEAR(volumes.rbegin()->second, 0.25, 1e-12);
  // The first area, 6, lacks the contact area, 1/4; the second is 1/4 + 2.
  EXPECT_NEAR(total(boundary_areas(mesh)), 8, 1e-12);
  EXPECT_EQ(mesh.remarks, Known());
}

// An overlap of solids stays in the first one only, and what is not a solid is
// left out; the remarks say so. The files: boxes that overlap, one whose second
// box has lost its shell, and one with a loose surface.
TEST(FileMesh, SolidsThatAreCutOrLost)
{
  const TemporaryFolder folder;
  write_shapes(folder / "overlap.step", [] {
    gmsh::model::occ::addBox(0, 0, 0, 2, 1, 1);
    gmsh::model::occ::addBox(1, 0, 0, 2, 1, 1);
  });
  const SerialMesh overlapping = read_file(folder / "overlap.step", "0.5");
  EXPECT_NEAR(total(region_volumes(overlapping)), 3, 1e-12);
  ASSERT_EQ(overlapping.remarks.size(), 1u);
  EXPECT_NE(overlapping.remarks[0].find("overlap: a volume of 1 is that of"),
            std::string::npos)
    << overlapping.remarks[0];

  write_shapes(folder / "two.step", [] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    gmsh::model::occ::addBox(3, 0, 0, 1, 1, 1);
  });
  std::string       text  = folder.read("two.step");
  const std::size_t brep  = text.rfind("MANIFOLD_SOLID_BREP(");
  const std::size_t shell = text.find('#', brep);
  ASSERT_NE(brep, std::string::npos);
  text.insert(shell + 1, "99");
  const SerialMesh rest = read_file(folder.write("lost.step", text), "0.5");
  EXPECT_NEAR(total(region_volumes(rest)), 1, 1e-12);
  EXPECT_EQ(rest.remarks,
            Known{
              "of 2 solids in the file 1 could be read, the others are left "
              "out: is a part of them missing?"});

  write_shapes(folder / "loose.step", [] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    gmsh::model::occ::addRectangle(3, 0, 0, 1, 1);
  });
  EXPECT_EQ(
    read_file(folder / "loose.step", "0.5").remarks,
    Known{"beside its solids the file has surfaces, which are left out: 1"});
}

// Surfaces of IGES files share nothing, not even their edges, which differ
// where one is a circle and the other a spline: they are sewn together. The
// body: a plate with a hole, a solid that touches the plate, a cone, which ends
// in a point, and a box with a hollow ball that has a box inside. Plane sides
// are exact, and a circle of n edges has an area of n r^2 sin(2 pi / n) / 2.
TEST(FileMesh, SurfacesAreSewn)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "parts.igs";
  write_shapes(file, [] {
    cut_solid(gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1),
              gmsh::model::occ::addCylinder(0.5, 0.5, -1, 0, 0, 3, 0.3));
    gmsh::model::occ::addBox(1, 0.25, 0.25, 1, 0.5, 0.5);
    gmsh::model::occ::addCone(4, 0, 0, 0, 0, 1, 0.5, 0);
    cut_solid(gmsh::model::occ::addBox(5, 0, 0, 2, 2, 2),
              gmsh::model::occ::addSphere(6, 1, 1, 0.8));
    gmsh::model::occ::addBox(5.8, 0.8, 0.8, 0.4, 0.4, 0.4);
  });
  const SerialMesh    mesh = read_file(file, "0.2");
  std::vector<double> volumes;
  for (const auto &[region, volume] : region_volumes(mesh))
    volumes.push_back(volume);
  std::ranges::sort(volumes);
  ASSERT_EQ(volumes.size(), 5u);
  const double pi = dealii::numbers::PI;
  // Circles have ten to twelve edges: a cone loses some more volume towards its
  // point, and a ball some 12 % in two directions.
  const double circle = 10 * std::sin(pi / 5) / 2;
  EXPECT_NEAR(volumes[0], 0.4 * 0.4 * 0.4, 1e-12);
  EXPECT_GT(volumes[1], circle * 0.5 * 0.5 / 3 * 0.98);
  EXPECT_LT(volumes[1], pi * 0.5 * 0.5 / 3);
  EXPECT_NEAR(volumes[2], 0.25, 1e-12);
  EXPECT_GT(volumes[3], 1 - pi * 0.3 * 0.3);
  EXPECT_LT(volumes[3], 1 - circle * 0.3 * 0.3);
  EXPECT_GT(volumes[4], 8 - 4 * pi / 3 * 0.512);
  EXPECT_LT(volumes[4], 8 - 4 * pi / 3 * 0.512 * 0.85);
  ASSERT_EQ(mesh.remarks.size(), 2u);
  EXPECT_EQ(mesh.remarks[0].compare(0, 27, "surfaces are sewn to solids"), 0)
    << mesh.remarks[0];
}

// Curved cells approximate the boundary of a ball as well as the degree of
// their maps allows.
TEST(FileMesh, CurvedCellsOfSolids)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "ball.stp";
  write_shapes(file, [] { gmsh::model::occ::addSphere(0, 0, 0, 1); });
  double errors[3];
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      const SerialMesh mesh = read_file(file, "0.4", std::to_string(degree));
      EXPECT_EQ(mesh.geometry_degree, degree);
      errors[degree - 1] =
        std::abs(mesh_quality(mesh).volume / (4 * dealii::numbers::PI / 3) - 1);
    }
  EXPECT_GT(errors[0], 1e-2);
  EXPECT_LT(errors[1], 2e-3);
  EXPECT_LT(errors[2], 2e-4);
}

// A tube (torus) that is thinner than the edges that are asked for: with three
// edges around it, gmsh's triangles cross each other. Edges get shorter there,
// which a remark says. The volume is that of the box without the ring, 1 - 2
// pi^2 R r^2 = 0.995: with twelve edges around, the tube has lost 5 % of its
// own volume, and its ring some more.
TEST(FileMesh, EdgesThatAreTooLongBecomeShorter)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "tube.step";
  write_shapes(file, [] {
    cut_solid(gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1),
              gmsh::model::occ::addTorus(0.5, 0.5, 0.5, 0.16, 0.04));
  });
  const SerialMesh mesh = read_file(file, "0.15");
  ASSERT_FALSE(mesh.remarks.empty());
  EXPECT_NE(mesh.remarks[0].find("down to a tenth as long"), std::string::npos)
    << mesh.remarks[0];
  const double ring = 2 * std::pow(dealii::numbers::PI, 2) * 0.16 * 0.04 * 0.04;
  const double lost = (mesh_quality(mesh).volume - (1 - ring)) / ring;
  EXPECT_GT(lost, 0.);
  EXPECT_LT(lost, 0.15);
}

// The file's names of solids name regions, and colours of surfaces boundaries.
TEST(FileMesh, NamesAndColours)
{
  const TemporaryFolder folder;
  const std::string     file = folder / "named.step";
  write_shapes(file, [] {
    gmsh::model::occ::addBox(0, 0, 0, 1, 1, 1);
    gmsh::model::occ::addBox(1, 0, 0, 1, 1, 1);
  });
  std::string text    = folder.read("named.step");
  const auto  replace = [&](const std::string &from, const std::string &to) {
    ASSERT_NE(text.find(from), std::string::npos) << from;
    for (std::size_t place = 0;
         (place = text.find(from, place)) != std::string::npos;
         place += to.size())
      text.replace(place, from.size(), to);
  };
  // The program that wrote the file has given products its own names.
  const std::size_t first = text.find("PRODUCT('"),
                    end   = text.find('\'', first + 9);
  const std::string whole = text.substr(first + 9, end - first - 9);
  replace(whole + ".1'", "Rubber pad'");
  replace(whole + ".2'", "Steel plate'");
  // The number of the entity, "#17" say, that stands before the given text.
  const auto number_before = [&](const std::string &what) {
    const std::size_t end = text.find(what), begin = text.rfind('#', end);
    return text.substr(begin, end - begin);
  };
  const std::string face = number_before(" = ADVANCED_FACE"),
                    context =
                      number_before(" = ( GEOMETRIC_REPRESENTATION_CONTEXT(3)");
  replace("ENDSEC;\nEND-ISO",
          "#9001=COLOUR_RGB('',1.,0.5,0.);\n"
          "#9002=FILL_AREA_STYLE_COLOUR('',#9001);\n"
          "#9003=FILL_AREA_STYLE('',(#9002));\n"
          "#9004=SURFACE_STYLE_FILL_AREA(#9003);\n"
          "#9005=SURFACE_SIDE_STYLE('',(#9004));\n"
          "#9006=SURFACE_STYLE_USAGE(.BOTH.,#9005);\n"
          "#9007=PRESENTATION_STYLE_ASSIGNMENT((#9006));\n"
          "#9008=STYLED_ITEM('',(#9007)," +
            face +
            ");\n"
            "#9009=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',"
            "(#9008)," +
            context + ");\nENDSEC;\nEND-ISO");
  folder.write("named.step", text);
  const SerialMesh mesh = read_file(file, "0.5");
  EXPECT_EQ(MeshNames("region", mesh.regions).known(),
            (Known{"Rubber pad", "Steel plate"}));
  const MeshNames boundaries("boundary", mesh.boundaries);
  const auto      ids = boundaries.ids("colour-ff8000", "");
  ASSERT_EQ(ids.size(), 1u);
  EXPECT_NEAR(boundary_areas(mesh).at(ids[0]), 1, 1e-12);
}

// The volumes of the parts in meshes/ that come from other programs are those
// of their design. Curved cells of degree 2 approximate circles to 1e-4.
TEST(FileMesh, ShippedParts)
{
  const double     pi   = dealii::numbers::PI;
  const SerialMesh clip = read_file(source_path("meshes/clip.inp"));
  EXPECT_EQ(clip.geometry_degree, 2u);
  const double volume = (pi / 2 * (12. * 12. - 10. * 10.) + 2 * 30. * 2.) * 8.;
  EXPECT_NEAR(mesh_quality(clip).volume, 1e-9 * volume, 1e-13 * volume);
  EXPECT_EQ(MeshNames("boundary", clip.boundaries).ids("lower-end", "").size(),
            1u);

  const SerialMesh mount =
    read_file(source_path("meshes/rubber_mount.step"), "8", "2");
  EXPECT_EQ(MeshNames("region", mount.regions).known(),
            (Known{"lower plate", "rubber", "upper plate"}));
  EXPECT_NEAR(mesh_quality(mount).volume,
              2 * 60. * 60. * 5. + pi * 20. * 20. * 30.,
              10.);
  const MeshNames boundaries("boundary", mount.boundaries);
  for (const std::string colour : {"colour-ff0000", "colour-0000ff"})
    EXPECT_NEAR(boundary_areas(mount).at(boundaries.ids(colour, "").at(0)),
                3600.,
                1e-9);
}

// The element size is far too small, like one in metres for a file in
// millimetres.
TEST(FileMesh, EdgesThatAreFarTooShort)
{
  const TemporaryFolder folder;
  write_shapes(folder / "box.step",
               [] { gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3); });
  // The number of cells is about 6 / (h^3 / sqrt(72)).
  EXPECT_NE(refusal([&] { read_file(folder / "box.step", "0.0001"); })
              .find("edges of 0.0001 make some 5e+13 cells of a body of 1 x 2 "
                    "x 3; 3e+08 are allowed"),
            std::string::npos);
}

TEST(FileMesh, AbaqusByContent)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("mesh.txt",
                 "** a comment\n\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n"
                 "*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n");
  EXPECT_NEAR(mesh_quality(read_file(file)).volume, 1 / 6., 1e-15);
  EXPECT_EQ(refusal([&] { read_file(file, "1"); }),
            "Mesh/file/Element size: only a geometry can be given an element "
            "size: found 1 for '" +
              file + "'; 0 is allowed");
}

TEST(FileMesh, Refusals)
{
  const TemporaryFolder folder;
  const std::string     text = folder.write("notes.txt", "Some text.\n");
  EXPECT_EQ(
    refusal([&] { read_file(text); }),
    "Mesh/file/File: the kind of mesh file is unknown: found '" + text +
      "'; allowed are .msh, .geo, .step, .stp, .iges, .igs, .brep, .stl, "
      ".ply, .obj, .off, "
      ".inp, .bdf, .nas, .unv, .vtk, .vtu, .mesh, .cgns, .med, .rmed, .h5");
  // The content of this file is not what its name and head say.
  const std::string step =
    folder.write("part.step", "ISO-10303-21;\nHEADER;\n");
  const std::string message = refusal([&] { read_file(step); });
  EXPECT_EQ(message.compare(0, step.size() + 7, step + ": gmsh:"), 0)
    << message;

  // OpenCASCADE would not come to an end with these files.
  const std::string brep = folder / "part.brep";
  write_shapes(brep, [] { gmsh::model::occ::addSphere(0, 0, 0, 1); });
  std::stringstream bytes;
  bytes << std::ifstream(brep).rdbuf();
  for (const std::size_t part : {2, 3, 5, 100})
    EXPECT_EQ(refusal([&] {
                read_file(
                  folder.write("cut.brep",
                               bytes.str().substr(
                                 0, bytes.str().size() * (part - 1) / part)));
              }),
              (folder / "cut.brep") + ": the file does not end with a shape "
                                      "behind those of TShapes: is the rest "
                                      "missing?");
  // A line behind the shapes may have any length.
  EXPECT_EQ(refusal([&] {
              read_file(folder.write("long.brep",
                                     bytes.str() + "*\n+" +
                                       std::string(1'000'000, '1') + " 0\n"));
            }),
            (folder / "long.brep") + ": the file does not end with a shape "
                                     "behind those of TShapes: is the rest "
                                     "missing?");

  const std::string open = folder / "open.step";
  write_shapes(open, [] {
    gmsh::model::occ::addRectangle(0, 0, 0, 1, 1);
    gmsh::model::occ::addRectangle(0, 0, 1, 1, 1);
  });
  EXPECT_EQ(refusal([&] { read_file(open); }),
            open + ": gmsh: the geometry has no solid: found 2 surfaces, which "
                   "do not close (edges where there are not two: 8); needed "
                   "are solids, or surfaces around them with gaps of at most a "
                   "thousandth of the size of all");
}
