// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The entries of section Output: accepted values mean what the documentation
// says, and others are refused with a reason.

#include <gtest/gtest.h>

#include "../refusal.h"
#include "support.h"

using corotet::InputError;
using corotet::OutputParameters;

namespace
{
  // The refusal of a value of the entry Probes, with the entry that it names.
  std::string
  probes_refusal(const std::string &probes)
  {
    OutputParameters parameters;
    parameters.probes = probes;
    return refusal([&] { parameters.probe_points(); });
  }
} // namespace

// The defaults, as ParameterHandler reads them.
TEST(OutputParameters, Defaults)
{
  OutputParameters         parameters;
  dealii::ParameterHandler prm;
  prm.enter_subsection("Output");
  parameters.declare_parameters(prm);
  prm.leave_subsection();
  prm.parse_input_from_string("subsection Output\n set Overwrite = true\nend");
  EXPECT_TRUE(parameters.overwrite);
  EXPECT_EQ(parameters.time_between_results, 0);
  EXPECT_EQ(parameters.time_between_states(4), 4. / 200);
  parameters.n_states = 0;
  EXPECT_EQ(parameters.time_between_states(4), 0);
  parameters.time_between_results = 3;
  EXPECT_EQ(parameters.time_between_states(4), 3);
  EXPECT_TRUE(parameters.probe_points().empty());
  EXPECT_EQ(parameters.directory_of_run("some/where/beam.prm"), "output/beam");
  parameters.directory = "here";
  EXPECT_EQ(parameters.directory_of_run("some/where/beam.prm"), "here");
}

TEST(OutputParameters, ProbesAreRead)
{
  OutputParameters parameters;
  parameters.probes = " tip: 1 0.05 -5e-2 ,mid_2:0.5   0 0";
  const auto points = parameters.probe_points();
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].name, "tip");
  EXPECT_EQ(points[0].position, dealii::Point<3>(1, 0.05, -0.05));
  EXPECT_EQ(points[1].name, "mid_2");
  EXPECT_EQ(points[1].position, dealii::Point<3>(0.5, 0, 0));
}

TEST(OutputParameters, WrongProbesAreRefused)
{
  EXPECT_EQ(probes_refusal("1 2 3"),
            "Output/Probes: found '1 2 3'; allowed: a list of NAME: X Y Z, "
            "separated by commas");
  EXPECT_EQ(
    probes_refusal("tip: 0 0 0,"),
    "Output/Probes: found ''; allowed: a list of NAME: X Y Z, separated "
    "by commas");
  EXPECT_EQ(probes_refusal("2nd: 1 2 3"),
            "Output/Probes: '2nd' cannot be a probe's name; letters, digits "
            "and _ are allowed, no digit first");
  EXPECT_EQ(probes_refusal(": 1 2 3"),
            "Output/Probes: '' cannot be a probe's name; letters, digits and "
            "_ are allowed, no digit first");
  EXPECT_EQ(probes_refusal("momentum: 1 2 3"),
            "Output/Probes: 'momentum' cannot be a probe's name; momentum, "
            "angular_momentum, reaction, internal_moment, mass_share, "
            "effective_mass are columns of the history or of modes already");
  EXPECT_EQ(probes_refusal("a: 1 2 3, a: 3 2 1"),
            "Output/Probes: two probes are called 'a'; each name must be used "
            "once");
  for (const std::string wrong :
       {"1 2", "1 2 3 4", "1 2 z", "1 2 inf", "1 2 3m"})
    EXPECT_EQ(probes_refusal("a: " + wrong),
              "Output/Probes: probe 'a' is at '" + wrong +
                "'; its position must be three numbers (x y z, in m)");
}
