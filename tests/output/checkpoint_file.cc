// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A checkpoint restores its content to the last bit, or is refused.

#include <corotet/output/checkpoint_checksum.h>
#include <corotet/output/checkpoint_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>

#include "support.h"

using namespace corotet;
using namespace test_output;

namespace
{
  // Values of all types, including awkward ones.
  struct Values
  {
    double              number  = 0;
    bool                is_true = false;
    unsigned int        count   = 0;
    std::int64_t        large   = 0;
    std::string         text;
    std::vector<double> numbers;
    std::vector<int>    integers;
    std::vector<double> nothing = {1};
    Vector              field, empty, zero;

    void
    transfer(Archive &archive)
    {
      archive.transfer("number", number);
      archive.within("part", [&] {
        archive.transfer("number", is_true);
        archive.within("inner", [&] { archive.transfer("number", count); });
        archive.transfer("large", large);
      });
      archive.transfer("text", text);
      archive.transfer("numbers", numbers);
      archive.transfer("integers", integers);
      archive.transfer("nothing", nothing);
      archive.within("vectors", [&] {
        archive.transfer("field", field);
        archive.transfer("empty", empty);
        archive.transfer("zero", zero);
      });
    }
  };

  Values
  awkward_values(const Discretization &discretization)
  {
    using Limits = std::numeric_limits<double>;
    Values values;
    values.number   = 0.1;
    values.is_true  = true;
    values.count    = 4294967295u;
    values.large    = std::numeric_limits<std::int64_t>::min();
    values.text     = "\"quoted\"\n\\ \t\u00e9";
    values.numbers  = {1. / 3,
                       -0.,
                       Limits::denorm_min(),
                       Limits::max(),
                       -Limits::infinity(),
                       Limits::quiet_NaN(),
                       1e23};
    values.integers = {3, -2};
    values.nothing  = {};
    discretization.initialize_vector(values.field);
    discretization.initialize_vector(values.zero);
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        values.field.local_element(3 * n + a) =
          discretization.node_position(n)[a] / 3 + a;
    return values;
  }

  class CheckpointFile : public testing::Test
  {
  protected:
    CheckpointFile()
      : body(Element(2))
      , order(FileOrder::of_nodes(body.discretization, body.discretization))
      , path(scratch.path + "/step_000001")
    {
      CheckpointWriter writer(path, body.discretization, order);
      Values           values = awkward_values(body.discretization);
      values.transfer(writer);
      writer.finish({{"Mesh", {{"Type", "box"}}}}, true);
      wait_for_all();
    }

    std::string
    refusal()
    {
      return message_of<Error>(
        [&] { CheckpointReader(path, body.discretization, order); });
    }

    const ScratchFolder scratch;
    ModelBody           body;
    const FileOrder     order;
    const std::string   path;
  };
} // namespace

TEST_F(CheckpointFile, ReadsBackExactly)
{
  CheckpointReader reader(path, body.discretization, order);
  EXPECT_EQ(reader.parameters().at("Mesh").at("Type"), "box");
  reader.check_mesh();
  const Values expected = awkward_values(body.discretization);
  Values       found;
  found.transfer(reader);
  EXPECT_EQ(found.number, expected.number);
  EXPECT_EQ(found.is_true, expected.is_true);
  EXPECT_EQ(found.count, expected.count);
  EXPECT_EQ(found.large, expected.large);
  EXPECT_EQ(found.text, expected.text);
  EXPECT_EQ(found.integers, expected.integers);
  EXPECT_TRUE(found.nothing.empty());
  ASSERT_EQ(found.numbers.size(), expected.numbers.size());
  for (std::size_t i = 0; i < found.numbers.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(found.numbers[i]),
              std::bit_cast<std::uint64_t>(expected.numbers[i]))
      << i;
  EXPECT_EQ(found.empty.size(), 0u);
  ASSERT_EQ(found.zero.size(), expected.zero.size());
  EXPECT_EQ(found.zero.linfty_norm(), 0.);
  ASSERT_EQ(found.field.size(), expected.field.size());
  for (unsigned int i = 0; i < found.field.locally_owned_size(); ++i)
    EXPECT_EQ(found.field.local_element(i), expected.field.local_element(i));
}

TEST_F(CheckpointFile, MissingValueIsAnError)
{
  CheckpointReader reader(path, body.discretization, order);
  double           number = 0;
  EXPECT_EQ(message_of<InputError>([&] { reader.transfer("absent", number); }),
            path + ".json: has no value of 'absent'");
}

TEST_F(CheckpointFile, TextIsNoNumber)
{
  CheckpointReader  reader(path, body.discretization, order);
  double            number = 0;
  bool              truth  = false;
  std::vector<int>  integers;
  const std::string behind = " for 'numbers', which is no such number";
  EXPECT_TRUE(message_of<InputError>([&] {
                reader.transfer("text", number);
              }).starts_with("a checkpoint has '\"quoted"));
  EXPECT_TRUE(message_of<InputError>([&] {
                reader.transfer("number", truth);
              }).ends_with("has '0.1' for 'number', which is no such number"));
  EXPECT_TRUE(message_of<InputError>([&] {
                reader.transfer("numbers", integers);
              }).ends_with(behind));
}

// The signs of zeros are kept, too.
TEST_F(CheckpointFile, NegativeZeros)
{
  const std::string zeros = scratch.path + "/step_000002";
  Vector            field;
  body.discretization.initialize_vector(field);
  for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
    field.local_element(i) = i % 2 == 0 ? 0. : -0.;
  {
    CheckpointWriter writer(zeros, body.discretization, order);
    writer.transfer("field", field);
    writer.finish({}, false);
  }
  wait_for_all();
  CheckpointReader reader(zeros, body.discretization, order);
  Vector           found;
  reader.transfer("field", found);
  for (unsigned int i = 0; i < found.locally_owned_size(); ++i)
    EXPECT_EQ(std::signbit(found.local_element(i)), i % 2 == 1);
}

TEST_F(CheckpointFile, MissingVectorsAreDamage)
{
  if (on_rank_0())
    std::filesystem::remove(path + ".h5");
  wait_for_all();
  EXPECT_EQ(refusal(), path + ".h5: damaged: there is no such file");
}

TEST_F(CheckpointFile, AnyFlippedBitIsFound)
{
  for (const std::string suffix : {".json", ".h5"})
    {
      const std::string whole = content_of(path + suffix);
      wait_for_all();
      // In each of 40 bytes all over the file, another bit is flipped.
      for (std::size_t k = 0; k < 40; ++k)
        {
          std::string damaged = whole;
          damaged[k * (whole.size() - 1) / 39] ^= 1 << k % 8;
          // White space may stand anywhere in JSON.
          if (on_rank_0())
            std::ofstream(path + suffix) << damaged;
          wait_for_all();
          const std::string message = refusal();
          EXPECT_TRUE(message.starts_with(path + suffix + ": damaged") ||
                      (message == "no error" && suffix == ".json" &&
                       std::isspace(whole[k * (whole.size() - 1) / 39]) != 0))
            << suffix << " " << k << ": " << message;
          wait_for_all();
        }
      if (on_rank_0())
        std::ofstream(path + suffix) << whole;
      wait_for_all();
    }
  EXPECT_EQ(refusal(), "no error");
}

TEST_F(CheckpointFile, OtherMeshIsRefused)
{
  SerialMesh moved = distorted_box();
  moved.vertices[3][1] += 1e-15;
  // Supports, loads and materials depend on the names of boundaries and
  // regions.
  SerialMesh other_boundary = distorted_box();
  // A face on the surface belongs to one cell only.
  std::map<std::array<unsigned int, 3>, unsigned int> n_cells;
  for (const SerialMesh::Cell &cell : other_boundary.cells)
    for (const auto &[i, j, k] : corners_of_faces)
      {
        std::array<unsigned int, 3> face{
          {cell.vertices[i], cell.vertices[j], cell.vertices[k]}};
        std::sort(face.begin(), face.end());
        ++n_cells[face];
      }
  const auto on_surface =
    std::find_if(n_cells.begin(), n_cells.end(), [](const auto &face) {
      return face.second == 1;
    });
  ASSERT_NE(on_surface, n_cells.end());
  other_boundary.boundaries.names[7] = "foot";
  other_boundary.faces.push_back({on_surface->first, 7});
  SerialMesh other_region = distorted_box();
  other_region.regions.names[other_region.cells[0].region] += "'";
  for (const SerialMesh &other : {moved, other_boundary, other_region})
    {
      Log                  log(MPI_COMM_WORLD, true);
      const Mesh           mesh(other, 0, 1, MPI_COMM_WORLD, log);
      const Discretization discretization(mesh, Element(2));
      CheckpointReader     reader(path, discretization, order);
      EXPECT_TRUE(
        message_of<InputError>([&] { reader.check_mesh(); })
          .starts_with(
            "--restart: found a mesh that is not that of the checkpoint "));
    }
}

// A correct checksum is no proof: the content is checked nevertheless.
TEST_F(CheckpointFile, WrongContentWithARightChecksum)
{
  using Json         = nlohmann::ordered_json;
  const Json content = Json::parse(content_of(path + ".json"));
  wait_for_all();
  const auto refusal_with = [&](const std::string &name, const Json &value) {
    Json changed = content;
    changed.erase("checksum");
    changed[name]       = value;
    changed["checksum"] = checkpoint_checksum::of_text(changed.dump());
    if (on_rank_0())
      std::ofstream(path + ".json") << changed.dump();
    wait_for_all();
    const std::string message = refusal();
    wait_for_all();
    return message;
  };
  const std::string damaged =
    path + ".json: damaged: it is no whole checkpoint";
  EXPECT_EQ(refusal_with("vectors_size", "many"), damaged);
  EXPECT_EQ(refusal_with("vectors_checksum", 3), damaged);
  EXPECT_EQ(refusal_with("cells", -1), damaged);
  EXPECT_EQ(refusal_with("values", {{"number", 3}}), damaged);
  EXPECT_EQ(refusal_with("parameters", {{"Mesh", {{"Type", 3}}}}), damaged);
  EXPECT_EQ(refusal_with("format", 1),
            path +
              ".json: found a checkpoint of format 1; allowed: 10, that of "
              "this program");
  Json deep = 1;
  for (unsigned int i = 0; i < 40; ++i)
    deep = Json{{"a", deep}};
  EXPECT_EQ(refusal_with("parameters", deep),
            path + ".json: damaged: it is nested more than 30 levels deep");
}
