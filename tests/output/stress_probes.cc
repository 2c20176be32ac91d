// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Stress at probes: it is exact where stress is constant in each material, the
// mean of both materials at their interface, and the same for any distribution
// over ranks; its columns are the last ones of the history.

#include <corotet/laws/linear.h>
#include <corotet/output/history_writer.h>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

#include "support.h"

using namespace corotet;
using namespace test_output;
using dealii::SymmetricTensor;

namespace
{
  // The box is soft on its left, stiff on its right.
  const std::map<unsigned int, IsotropicMaterial> materials{
    {7, isotropic_material(10., 0.3, 1.)},
    {8, isotropic_material(1000., 0.1, 1.)}};

  const std::string places =
    "left: 0.2 0.3 0.1, right: 0.8 0.5 0.25, between: 0.5 0 0";

  // Sets the displacement u = (2 y, 0.1 y, z - x) / 100.
  void
  set_displacement(ModelBody &body)
  {
    for (unsigned int n = 0; n < body.discretization.n_local_nodes(); ++n)
      {
        const auto x = body.discretization.node_position(n);
        body.displacement.local_element(3 * n)     = 0.02 * x[1];
        body.displacement.local_element(3 * n + 1) = 0.001 * x[1];
        body.displacement.local_element(3 * n + 2) = 0.01 * (x[2] - x[0]);
      }
  }

  SymmetricTensor<2, 3>
  strain()
  {
    SymmetricTensor<2, 3> result;
    result[0][1] = 0.01;
    result[1][1] = 0.001;
    result[2][2] = 0.01;
    result[0][2] = -0.005;
    return result;
  }

  StressProbes
  probes_at(const std::string &text, const ModelBody &body)
  {
    OutputParameters parameters;
    parameters.stress_probes = text;
    return {parameters.stress_probe_points(), body.discretization};
  }
} // namespace

// The tolerance is the round-off of fits whose normal equations have condition
// 1e3.
TEST(StressProbes, ExactInEachMaterial)
{
  for (const unsigned int degree : {1, 2, 3})
    {
      ModelBody              body(degree);
      const ReferenceElement reference(degree);
      StressField            field(
        body.discretization, reference, materials, linear_law(), nullptr);
      set_displacement(body);
      field.set_displacement(body.displacement);
      const auto left  = stress(materials.at(7), strain()),
                 right = stress(materials.at(8), strain());
      const auto found = probes_at(places, body).stresses(field);
      ASSERT_EQ(found.size(), 3u);
      EXPECT_LE((found[0] - left).norm(), 1e-12 * left.norm());
      EXPECT_LE((found[1] - right).norm(), 1e-12 * right.norm());
      EXPECT_LE((found[2] - 0.5 * (left + right)).norm(), 1e-12 * right.norm());
    }
}

// For degree 1 raw stress is constant in cells, and a probe inside a cell shows
// that of the cell; the recovered stress differs from it where stress varies.
TEST(StressProbes, Raw)
{
  ModelBody              body(1);
  const ReferenceElement reference(1);
  StressField            field(
    body.discretization, reference, materials, linear_law(), nullptr);
  for (unsigned int n = 0; n < body.discretization.n_local_nodes(); ++n)
    {
      const auto x = body.discretization.node_position(n);
      body.displacement.local_element(3 * n) = 0.01 * x[0] * x[0] - x[1] * x[2];
    }
  field.set_displacement(body.displacement);
  OutputParameters parameters;
  parameters.stress_probes = "inside: 0.23 0.31 0.17";
  for (const bool raw : {true, false})
    {
      const auto found =
        StressProbes(parameters.stress_probe_points(), body.discretization, raw)
          .stresses(field)[0];
      double nearest = 1e300;
      for (unsigned int c = 0; c < body.discretization.n_owned_cells(); ++c)
        nearest = std::min(nearest, (field.at_points()[c] - found).norm());
      nearest = dealii::Utilities::MPI::min(nearest, MPI_COMM_WORLD);
      EXPECT_EQ(nearest < 1e-12 * found.norm(), raw);
    }
}

TEST(StressProbes, ColumnsOfTheHistory)
{
  ModelBody              body(1);
  const ReferenceElement reference(1);
  StressField            field(
    body.discretization, reference, materials, linear_law(), nullptr);
  set_displacement(body);
  field.set_displacement(body.displacement);
  nlohmann::ordered_json row;
  const StressProbes     probes = probes_at("a: 0.8 0.5 0.25", body);
  add_stress_columns(row, probes.names(), probes.stresses(field));
  const auto sigma = stress(materials.at(8), strain());
  const std::vector<std::pair<std::string, double>> expected{
    {"a_stress_xx", sigma[0][0]},
    {"a_stress_yy", sigma[1][1]},
    {"a_stress_zz", sigma[2][2]},
    {"a_stress_xy", sigma[0][1]},
    {"a_stress_yz", sigma[1][2]},
    {"a_stress_xz", sigma[0][2]},
    {"a_von_mises", von_mises(sigma)}};
  ASSERT_EQ(row.size(), expected.size());
  auto column = row.items().begin();
  for (const auto &[name, value] : expected)
    {
      EXPECT_EQ(column.key(), name);
      EXPECT_NEAR(column.value().get<double>(), value, 1e-12 * sigma.norm());
      ++column;
    }
}

TEST(StressProbes, Refusals)
{
  ModelBody  body(1);
  const auto refusal = [&](const std::string &text) {
    return message_of<InputError>([&] { probes_at(text, body); });
  };
  EXPECT_EQ(refusal("far: 2 0 0"),
            "probe 'far' at (2, 0, 0) lies outside the body, 1 m from its "
            "nearest node; the body has x in [0, 1], y in [0, 0.5], z in "
            "[0, 0.25] (m)");
  EXPECT_EQ(refusal("a: 1 2"),
            "probe 'a' is at '1 2'; its position must be three numbers (x y z, "
            "in m)");
  // Columns of stress probes have other names than those of displacements, so
  // the name "reaction" is allowed.
  EXPECT_EQ(refusal("reaction: 0 0 0"), "no error");
}
