// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The parts in meshes/ are what their README says.

#include <corotet/mesh/check_mesh.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  const double pi = std::acos(-1.);

  // Areas [m^2]: the profile of plate, arm and fillet seen from the side, and
  // the three holes.
  const double fillet          = (1 - pi / 4) * 0.012 * 0.012;
  const double bracket_profile = 0.008 * 0.080 + 0.092 * 0.008 + fillet;
  const double bracket_holes   = pi * (2 * 0.005 * 0.005 + 0.008 * 0.008);
} // namespace

struct Part
{
  std::string                         name;
  double                              volume;
  std::map<unsigned int, std::string> regions;
  std::set<std::string>               boundaries;
  // The relative error of the volume: how much coarse facets cut off or add at
  // round surfaces.
  double tolerance;
};

// The name of a part in test reports.
std::ostream &
operator<<(std::ostream &stream, const Part &part)
{
  return stream << part.name;
}

class ShippedMesh : public testing::TestWithParam<Part>
{};

// Every part in meshes/, as geometry and as mesh, passes all checks, has the
// names that its users rely on and, up to its facets, the volume of its design.
TEST_P(ShippedMesh, LoadsAndPassesTheChecks)
{
  for (const std::string extension : {".geo", ".msh"})
    {
      SCOPED_TRACE(extension);
      SerialMesh mesh =
        read_gmsh(GetParam().name + extension, source_path("meshes"));
      check_mesh(mesh);
      // Parts with round surfaces have one remark, about straight cells or
      // facets.
      EXPECT_EQ(mesh.remarks.size(), GetParam().tolerance > 1e-9 ? 1u : 0u);
      EXPECT_EQ(mesh.regions.names, GetParam().regions);

      std::set<std::string> found;
      for (const auto &[id, area] : boundary_areas(mesh))
        found.insert(mesh.boundaries.names.at(id));
      EXPECT_EQ(found, GetParam().boundaries);

      const MeshQuality quality = mesh_quality(mesh);
      EXPECT_NEAR(quality.volume / GetParam().volume, 1, GetParam().tolerance);
      EXPECT_GT(quality.smallest_dihedral_angle, 5);
      EXPECT_LT(quality.worst_aspect_ratio, 10);
      EXPECT_LT(mesh.cells.size(), 6000u);
    }
}

// Volumes from the dimensions in the .geo files [m^3].
const std::vector<Part> parts = {
  Part{"bracket",
       0.060 * bracket_profile - 0.008 * bracket_holes,
       {{1, "bracket"}},
       {"wall", "wall-holes", "tip", "tip-hole", "top"},
       0.005},
  // Volume of the prongs, of half a ring, and of the stem outside of the ring.
  // The tolerance covers how far the stem reaches into the ring, which is less
  // than its radius^2 / ring radius.
  Part{"tuning_fork",
       2 * 0.005 * 0.005 * 0.080 +
         pi / 2 * (0.010 * 0.010 - 0.005 * 0.005) * 0.005 +
         pi * 0.003 * 0.003 * 0.030,
       {{1, "fork"}},
       {"stem", "prong-left", "prong-right", "side-left", "side-right"},
       0.02},
  // A tube with six to eight facets around a helix: the area of a regular
  // hexagon in a circle is 0.83 of the circle's.
  Part{"spiral_spring",
       pi * 0.003 * 0.003 * 3 * std::hypot(2 * pi * 0.020, 0.012),
       {{1, "spring"}},
       {"bottom", "top"},
       0.17},
  Part{"two_material_beam",
       0.4 * 0.04 * 0.04,
       {{1, "steel"}, {2, "rubber"}},
       {"left", "right", "top"},
       1e-12},
  // Forty-five degrees of a ring with a section of 1 x 1; cells have chords as
  // sides.
  Part{"bend_45", 100 * pi / 4, {{1, "bend"}}, {"fixed", "tip"}, 1e-3},
  Part{"cook",
       48 * (44 + 16) / 2. * 5,
       {{1, "panel"}},
       {"clamped", "loaded", "front", "back"},
       1e-12},
  // All its surfaces are free; none has a name.
  Part{"l_block", (1 - 0.6 * 0.6) * 0.3, {{1, "block"}}, {}, 1e-12},
  Part{"patch_cube",
       1,
       {{1, "cube"}},
       {"x-min", "x-max", "y-min", "y-max", "z-min", "z-max"},
       1e-12}};

INSTANTIATE_TEST_SUITE_P(Parts,
                         ShippedMesh,
                         testing::ValuesIn(parts),
                         testing::PrintToStringParamName());
