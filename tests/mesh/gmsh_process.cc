// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// gmsh runs in a process of its own: whatever a file does there, or whatever
// happens to that process, corotet ends with a message.

#include <corotet/mesh/gmsh_process.h>

#include <fmt/format.h>
#include <gmsh.h>
#include <gtest/gtest.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <functional>
#include <iterator>
#include <map>
#include <random>

#include "mesh/tools.h"

using namespace corotet;
using namespace corotet::tests;

namespace
{
  std::string
  message_of(const std::string &file)
  {
    return refusal([&] { read_gmsh(file); });
  }

  const std::string box_geometry =
    "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 2, 3};\n";

  bool
  has_landlock()
  {
    return syscall(SYS_landlock_create_ruleset,
                   nullptr,
                   0,
                   LANDLOCK_CREATE_RULESET_VERSION) > 0;
  }

  // A binary mesh of version 4.1.
  std::string
  binary_mesh(const TemporaryFolder &folder)
  {
    const std::string file = folder / "box.msh";
    gmsh::initialize(0, nullptr, false, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::model::occ::addBox(0, 0, 0, 1, 2, 3);
    gmsh::model::occ::synchronize();
    gmsh::model::mesh::generate(3);
    gmsh::option::setNumber("Mesh.Binary", 1);
    gmsh::write(file);
    gmsh::finalize();
    return file;
  }
} // namespace

// The message names file, line, word and reason before gmsh sees the file.
TEST(GmshProcess, GeometryMayNotDoHarm)
{
  const TemporaryFolder folder;
  const std::string     marker = folder / "made";
  const std::string     end =
    "; a geometry may not run commands, write files, read files outside of its "
    "folder, wait, or end gmsh (cells are taken from gmsh as they are: nothing "
    "needs to be saved)";
  const std::pair<std::string, std::string> deeds[] = {
    {"SystemCall \"touch " + marker + "\";",
     "found 'SystemCall', which runs a command"},
    {"NonBlockingSystemCall \"touch " + marker + "\";",
     "found 'NonBlockingSystemCall', which runs a command"},
    {"Field[1] = ExternalProcess;",
     "found 'ExternalProcess', which runs a command"},
    {"/* Exit; */ Save \"" + marker + "\";",
     "found 'Save', which writes a file"},
    {"/*/ ' */ Save \"" + marker + "\"; //'",
     "found 'Save', which writes a file"},
    {"Print \"" + marker + "\";", "found 'Print', which writes a file"},
    {"Printf(\"%g\", Sin(1)) > \"" + marker + "\";",
     "found 'Printf', which writes a file here"},
    {"Printf(\"(a)\") >> \"" + marker + "\";",
     "found 'Printf', which writes a file here"},
    {"CreateDir \"" + marker + "\";",
     "found 'CreateDir', which makes a folder"},
    {"If (1)\nExit;\nEndIf", "found 'Exit', which ends gmsh"},
    {"Abort;", "found 'Abort', which ends gmsh"},
    {"Include \"/etc/hostname\";",
     "found '/etc/hostname', which reads a file outside of the folder of the "
     "geometry"},
    {"Merge \"../../x.stl\";",
     "found '../../x.stl', which reads a file outside of the folder of the "
     "geometry"},
    {"v() = ShapeFromFile(\"/tmp/x.step\");",
     "found '/tmp/x.step', which reads a file outside of the folder of the "
     "geometry"}};
  for (const auto &[statement, what] : deeds)
    {
      const std::string file =
        folder.write("x.geo", box_geometry + statement + "\n");
      const int line = statement.starts_with("If") ? 4 : 3;
      EXPECT_EQ(message_of(file),
                file + ":" + std::to_string(line) + ": " + what + end);
    }
  // A zero byte ends a comment for gmsh, but not for a reader of lines.
  const std::string with_zero =
    folder.write("x.geo", std::string("// \0 Exit;\n", 11));
  EXPECT_EQ(message_of(with_zero),
            with_zero + ": is no text: found a byte that is zero");
  // gmsh leaves out a last line without a line break.
  const std::string cut = folder.write("x.geo", "x = 1;\ny = 2;");
  EXPECT_EQ(message_of(cut),
            cut + ":2: the last line does not end with a line break: gmsh "
                  "would leave it out");
  // A forbidden word in a file that is included is reported with that file and
  // line; a link may not lead out of the folder either.
  const std::string part = folder.write("part.geo", "x = 1;\nExit;\n");
  EXPECT_EQ(message_of(folder.write("x.geo", "Include \"part.geo\";\n")),
            part + ":2: found 'Exit', which ends gmsh" + end);
  std::filesystem::create_symlink("/etc", folder / "link");
  const std::string file =
    folder.write("x.geo", "Include \"link/hostname\";\n");
  EXPECT_EQ(message_of(file),
            file +
              ":1: found 'link/hostname', which reads a file outside of "
              "the folder of the geometry" +
              end);
  EXPECT_FALSE(std::filesystem::exists(marker));
}

// Words in strings, comments and names of options are harmless, and files of
// the folder may be read.
TEST(GmshProcess, HarmlessGeometry)
{
  const TemporaryFolder folder;
  folder.write("part.geo", "Physical Volume(\"Exit\", 3) = {1};\n");
  const SerialMesh mesh = read_gmsh(
    folder.write("x.geo",
                 box_geometry + "// SystemCall \"x\";\nPrint.Background = 0;\n"
                                "Printf(\"2 > 1\");\nIf (2 > 1)\nEndIf\n"
                                "/*/ Save \"x\"; /*/\n"
                                "Include \"part.geo\";\n"));
  EXPECT_EQ(mesh.regions.names.at(3), "Exit");
  EXPECT_NEAR(mesh_quality(mesh).volume, 6, 1e-12);
}

// A file name that is known at run time only: here the kernel refuses access.
TEST(GmshProcess, NothingIsReadOutside)
{
  if (!has_landlock())
    GTEST_SKIP() << "the kernel has no Landlock";
  const TemporaryFolder folder, other;
  other.write("part.geo", box_geometry);
  const std::string include =
    "Include StrCat(\"" + (other / "") + "\", \"part.geo\");\n";
  const std::string message = message_of(folder.write("x.geo", include));
  EXPECT_NE(message.find("part.geo"), std::string::npos) << message;
  // The same file is read where it is in the folder of the geometry.
  const std::string own = other.write("x.geo", include);
  EXPECT_NEAR(mesh_quality(read_gmsh(own)).volume, 6, 1e-12);
}

TEST(GmshProcess, TimeLimit)
{
  const TemporaryFolder folder;
  const std::string     file =
    folder.write("x.geo", "For i In {1 : 1000000000}\nx = i;\nEndFor\n");
  GmshMesh                 source;
  dealii::ParameterHandler prm;
  source.declare_parameters(prm);
  prm.set("File", file);
  prm.set("Time limit", "1");
  EXPECT_EQ(refusal([&] { source.create(""); }),
            "Mesh/gmsh/Time limit: " + file +
              ": gmsh has not come to an end in 1 s");
}

// The header of the file promises more nodes than the file has.
TEST(GmshProcess, MemoryLimit)
{
  const TemporaryFolder folder;
  // The message about gmsh's failure has no line; that of corotet's own reader
  // for version 2 names the line behind the number.
  const std::map<std::string, std::string> starts{
    {"4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2000000000 1 2000000000\n"
     "3 1 0 2000000000\n",
     ": "},
    {"2.2 0 8\n$EndMeshFormat\n$Nodes\n2000000000\n",
     ":6: a number is expected: found '$EndNodes'"}};
  for (const auto &[start, place] : starts)
    {
      const std::string file =
        folder.write("x.msh",
                     "$MeshFormat\n" + start +
                       "$EndNodes\n$Elements\n0\n$EndElements\n");
      const std::string message = message_of(file);
      EXPECT_EQ(message.find(file + place), 0u) << message;
    }
}

// Files with changed bytes give a mesh, or a message about the file. Some of
// them end gmsh by a signal.
TEST(GmshProcess, DamagedBinaryMeshes)
{
  const TemporaryFolder folder;
  const std::string     good = binary_mesh(folder);
  std::ifstream         stream(good, std::ios::binary);
  const std::string     content{std::istreambuf_iterator<char>(stream), {}};
  std::mt19937          random(1);
  unsigned int          n_refused = 0;
  for (unsigned int i = 0; i < 40; ++i)
    {
      std::string damaged = content;
      for (unsigned int k = 0; k <= i % 4; ++k)
        damaged[random() % damaged.size()] = static_cast<char>(random());
      const std::string file = folder.write("damaged.msh", damaged);
      try
        {
          read_gmsh(file);
        }
      catch (const InputError &error)
        {
          ++n_refused;
          EXPECT_EQ(std::string(error.what()).find(file + ": "), 0u)
            << error.what();
        }
    }
  EXPECT_GT(n_refused, 5u);
  EXPECT_LT(n_refused, 40u);
}

TEST(GmshProcess, DeepIncludes)
{
  const TemporaryFolder folder;
  for (unsigned int i = 0; i < 30; ++i)
    folder.write(fmt::format("part_{}.geo", i),
                 fmt::format("Include \"part_{}.geo\";\n", i + 1));
  EXPECT_EQ(message_of(folder / "part_0.geo"),
            (folder / "part_21.geo") +
              ": files include each other more than 20 deep");
}

// A damaged process of gmsh may hand back anything: the result is a model or a
// message.
TEST(GmshProcess, OtherModels)
{
  GmshModel model;
  model.volume_types = {{4, "Tetrahedron 4", 1, std::vector<double>(12)}};
  model.volumes      = {{1, 4, {1, 2, 3, 4}}};
  model.node_tags    = {1, 2, 3, 4};
  model.coordinates.resize(12);
  const auto message_about = [](GmshModel changed) {
    std::string bytes;
    BytesWriter writer([&](const std::string_view part) { bytes += part; });
    transfer(writer, changed);
    return refusal([&] { model_of_bytes(bytes, "x.msh"); });
  };
  EXPECT_EQ(message_about(model), "nothing was refused");
  const std::string message =
    "x.msh: gmsh has handed back what is no mesh; is the file damaged?";
  const std::function<void(GmshModel &)> changes[] = {
    [](GmshModel &changed) { changed.volumes[0].nodes.push_back(1); },
    [](GmshModel &changed) { changed.volumes[0].type = 11; },
    [](GmshModel &changed) { changed.volume_types[0].nodes.resize(11); },
    [](GmshModel &changed) { changed.surfaces = {{1, 3, {1, 2, 3}}}; },
    [](GmshModel &changed) { changed.surfaces = {{1, 2, {1, 2}}}; },
    [](GmshModel &changed) { changed.coordinates.pop_back(); },
    [](GmshModel &changed) { changed.groups = {{3, -1, "a", {1}}}; },
    [](GmshModel &changed) { changed.groups = {{4, 1, "a", {1}}}; },
    [](GmshModel &changed) { changed.curves = {{1, 1, {1, 2, 3}}}; },
    [](GmshModel &changed) { changed.curves = {{1, 15, {1}}}; },
    [](GmshModel &changed) { changed.points = {{1, 1, {1, 2}}}; },
    // A wrong model is refused, also if it comes with a message of gmsh.
    [](GmshModel &changed) {
      changed.error    = "no mesh";
      changed.surfaces = {{1, 3, {1, 2, 3}}};
    }};
  for (const auto &change : changes)
    {
      GmshModel changed = model;
      change(changed);
      EXPECT_EQ(message_about(changed), message);
    }
  EXPECT_EQ(refusal([] { model_of_bytes("abc", "x.msh"); }), message);
  // The reference nodes are wrong: here all are at one place.
  EXPECT_EQ(refusal([&] { mesh_of_model(model, "x.msh", false); }),
            "x.msh: gmsh has handed back other reference nodes than those of "
            "its tetrahedra; is the file damaged?");
}
