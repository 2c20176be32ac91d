// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The unit of lengths in files of CAD programs.

#include <corotet/mesh/mesh.h>

#include <gmsh.h>
#include <gtest/gtest.h>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

// OpenCASCADE converts all units to millimetres; a remark names the unit of the
// file.
TEST(UnitsOfShapes, Step)
{
  const TemporaryFolder folder;
  write_shapes(folder / "box.step",
               [] { gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3); });
  const std::string text  = folder.read("box.step");
  const std::string milli = "SI_UNIT(.MILLI.,.METRE.)";
  for (const auto &[prefix, unit, factor] :
       {std::tuple("$", "metre", 1000.),
        std::tuple(".CENTI.", "centimetre", 10.)})
    {
      std::string other = text;
      for (std::size_t i = other.find(milli); i != std::string::npos;
           i             = other.find(milli))
        other.replace(i,
                      milli.size(),
                      "SI_UNIT(" + std::string(prefix) + ",.METRE.)");
      const SerialMesh mesh = read_file(folder.write("other.step", other));
      EXPECT_NEAR(total(region_volumes(mesh)),
                  6 * std::pow(factor, 3),
                  1e-6 * std::pow(factor, 3));
      EXPECT_EQ(mesh.remarks,
                std::vector<std::string>{
                  "coordinates are in millimetre: those of the file, in " +
                  std::string(unit) + ", have been converted"});
    }
}

// A part of 30 mm must not become one of 30 m without a warning.
TEST(UnitsOfShapes, MillimetresTakenForMetres)
{
  const TemporaryFolder folder;
  write_shapes(folder / "box.step",
               [] { gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3); });
  for (const double scale : {1., 0.001})
    {
      MeshParameters           parameters;
      dealii::ParameterHandler prm;
      parameters.declare_parameters(prm);
      prm.parse_input_from_string(
        "set Type = file\nset Scale = " + std::to_string(scale) +
        "\nsubsection file\nset File = box.step\n"
        "end\n");
      testing::internal::CaptureStdout();
      {
        Log        log(MPI_COMM_SELF, false);
        const Mesh mesh(parameters, folder / "", MPI_COMM_SELF, log);
      }
      const std::string text = testing::internal::GetCapturedStdout();
      EXPECT_EQ(text.find("taken for metres") != std::string::npos, scale == 1)
        << text;
    }
}
