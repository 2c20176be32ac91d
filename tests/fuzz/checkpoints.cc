// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Checkpoints: an input has the bytes of the .json file, a zero byte, and the
// bytes of the .h5 file. They are read as they are, and again with correct
// checksums, so that more than the checksums is tested.

#include <corotet/base/log.h>
#include <corotet/output/checkpoint_checksum.h>
#include <corotet/output/checkpoint_file.h>
#include <corotet/output/vtkhdf_series.h>

#include <mpi.h>

#include "targets.h"

namespace fuzz
{
  namespace
  {
    using namespace corotet::checkpoint_checksum;
    using Json = nlohmann::ordered_json;

    // A body of one cell.
    struct OneCell
    {
      OneCell()
        : log(MPI_COMM_SELF, true)
        , mesh(cell(), 0, 1., MPI_COMM_SELF, log)
        , discretization(mesh, corotet::Element(1))
        , order(corotet::FileOrder::of_nodes(discretization, discretization))
      {}

      static corotet::SerialMesh
      cell()
      {
        corotet::SerialMesh mesh;
        mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        mesh.cells    = {{{{0, 1, 2, 3}}, 0}};
        return mesh;
      }

      corotet::Log            log;
      corotet::Mesh           mesh;
      corotet::Discretization discretization;
      corotet::FileOrder      order;
    };

    // Reads values of all kinds.
    void
    read_all(const std::string &path, const OneCell &body)
    {
      std::unique_ptr<corotet::CheckpointReader> reader;
      if (!is_accepted([&] {
            reader =
              std::make_unique<corotet::CheckpointReader>(path,
                                                          body.discretization,
                                                          body.order);
          }))
        return;
      is_accepted([&] { reader->check_mesh(); });
      const auto read = [&](const std::string &name, auto value) {
        is_accepted([&] { reader->transfer(name, value); });
      };
      read("log_size", std::int64_t());
      read("number", double());
      read("truth", bool());
      read("text", std::string());
      read("numbers", std::vector<double>());
      reader->within("state", [&] { read("u", corotet::Vector()); });
      reader->within("state", [&] { read("v", corotet::Vector()); });
      corotet::VtkhdfSeries series(scratch() / "", "solution", 0., 50);
      is_accepted([&] { series.transfer(*reader); });
      // A restart compares these values with those of the new run.
      for (const auto &[section, entries] : reader->parameters().items())
        for (const auto &[name, value] : entries.items())
          if (value.is_string())
            value.get<std::string>();
    }

    // The text of a .json file with correct checksums; unchanged where the text
    // does not allow them.
    std::string
    with_checksums(const std::string &text, const std::string &vectors)
    {
      constexpr int max_depth = 100;
      bool          is_deep   = false;
      Json          content   = Json::parse(
        text,
        [&](const int depth, const auto, const auto &) {
          is_deep = is_deep || depth > max_depth;
          return !is_deep;
        },
        /* allow_exceptions = */ false);
      if (is_deep || !content.is_object())
        return text;
      try
        {
          content["vectors_size"] = vectors.size();
          content["vectors_checksum"] =
            in_words(of_bytes(vectors.data(), vectors.size(), 0));
          content.erase("checksum");
          content["checksum"] = of_text(content.dump());
          return content.dump();
        }
      catch (const Json::exception &)
        {
          // The text is not UTF-8.
          return text;
        }
    }
  } // namespace

  void
  read_checkpoint(const std::string &input)
  {
    static const OneCell body;
    const std::size_t    cut  = input.find('\0');
    const std::string    text = input.substr(0, cut);
    const std::string    vectors =
      cut == std::string::npos ? "" : input.substr(cut + 1);
    const std::string path = scratch() / "step_000001";
    write("step_000001.h5", vectors);
    for (const std::string &content : {text, with_checksums(text, vectors)})
      {
        write("step_000001.json", content);
        read_all(path, body);
      }
  }
} // namespace fuzz
