// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/hdf5_tables.h>
#include <corotet/base/mpi.h>
#include <corotet/base/version.h>
#include <corotet/base/whole_file.h>
#include <corotet/output/checkpoint_checksum.h>
#include <corotet/output/checkpoint_file.h>
#include <corotet/output/mesh_checksum.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <system_error>

namespace corotet
{
  namespace
  {
    using Json = nlohmann::ordered_json;

    // The version of the content of checkpoints and its meaning.
    constexpr int format_version = 10;

    class FileDescriptor
    {
    public:
      explicit FileDescriptor(const std::string &path)
        : number(open(path.c_str(), O_RDONLY | O_CLOEXEC))
      {
        if (number < 0)
          throw MachineError(path + ": " + std::strerror(errno));
      }

      FileDescriptor(const FileDescriptor &) = delete;
      FileDescriptor &
      operator=(const FileDescriptor &) = delete;

      ~FileDescriptor()
      {
        close(number);
      }

      // Reads up to @p size bytes; fewer at the end of the file.
      std::size_t
      read(char *data, const std::size_t size, const std::uint64_t place) const
      {
        std::size_t done = 0;
        while (done < size)
          {
            const ssize_t n =
              pread(number, data + done, size - done, place + done);
            if (n < 0 && errno == EINTR)
              continue;
            if (n < 0)
              throw MachineError(std::string("a checkpoint cannot be read: ") +
                                 std::strerror(errno));
            if (n == 0)
              break;
            done += n;
          }
        return done;
      }

    private:
      int number;
    };

    struct FileContent
    {
      std::uint64_t size;
      std::string   checksum;
    };

    // Reads a file, a part on each rank. Collective.
    FileContent
    content_of_file(const std::string &path, const MPI_Comm comm)
    {
      const std::uint64_t n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(comm);
      const std::uint64_t rank = dealii::Utilities::MPI::this_mpi_process(comm);
      std::uint64_t       size = 0, sum = 0;
      on_all_ranks(comm, [&] {
        std::error_code error;
        size = std::filesystem::file_size(path, error);
        if (error)
          throw MachineError(path + ": " + error.message());
        const FileDescriptor file(path);
        const std::uint64_t  n_words = (size + 7) / 8;
        const std::uint64_t  part    = (n_words + n_ranks - 1) / n_ranks;
        std::vector<char>    buffer(1 << 20);
        const std::uint64_t  end = std::min(8 * part * (rank + 1), size);
        for (std::uint64_t place = 8 * part * rank; place < end;)
          {
            const std::size_t n =
              file.read(buffer.data(),
                        std::min<std::uint64_t>(buffer.size(), end - place),
                        place);
            if (n == 0)
              break;
            sum += checkpoint_checksum::of_bytes(buffer.data(), n, place / 8);
            place += n;
          }
      });
      return {size,
              checkpoint_checksum::in_words(
                dealii::Utilities::MPI::sum(sum, comm))};
    }

    // Whether all bits of all entries are 0, so that none is -0. Collective.
    bool
    has_no_bits(const Vector &vector)
    {
      const bool here =
        std::all_of(vector.begin(), vector.end(), [](const double x) {
          std::uint64_t word = 0;
          std::memcpy(&word, &x, sizeof(word));
          return word == 0;
        });
      return dealii::Utilities::MPI::min(here ? 1 : 0,
                                         vector.get_mpi_communicator()) == 1;
    }

    // Replaces slashes, which would make groups.
    std::string
    table_name(std::string name)
    {
      std::replace(name.begin(), name.end(), '/', '.');
      return name;
    }

    // Whether all values have the expected types: a file with a right checksum
    // may still have been made by anybody.
    bool
    has_all_parts(const Json &content)
    {
      const auto is_text = [&](const char *name) {
        return content.at(name).is_string();
      };
      const auto is_number = [&](const char *name) {
        return content.at(name).is_number_unsigned();
      };
      const std::function<bool(const Json &)> are_entries =
        [&](const Json &section) {
          return std::all_of(section.begin(),
                             section.end(),
                             [&](const Json &node) {
                               return node.is_string() ||
                                      (node.is_object() && are_entries(node));
                             });
        };
      const Json &parameters = content.at("parameters");
      const Json &values     = content.at("values");
      return is_number("format") && is_number("cells") &&
             is_number("vectors_size") && is_text("mesh_checksum") &&
             is_text("vectors_checksum") &&
             (parameters.is_object() || parameters.is_null()) &&
             are_entries(parameters) && values.is_object() &&
             std::all_of(values.begin(), values.end(), [](const Json &value) {
               return value.is_string();
             });
    }

    Json
    parse_content(const std::string &text, const std::string &file)
    {
      // The depth of the sections of parameters, and of what contains them.
      constexpr int max_depth = 30;
      return Json::parse(text, [&](const int depth, const auto, const auto &) {
        if (depth > max_depth)
          throw InputError("",
                           fmt::format("{}: damaged: it is nested more than {} "
                                       "levels deep",
                                       file,
                                       max_depth));
        return true;
      });
    }

    // Reads and checks PATH.json. Called on rank 0.
    Json
    read_content(const std::string &file)
    {
      // A failure here does not mean that the checkpoint is damaged.
      const std::string text = read_whole_file(file);
      try
        {
          Json              content  = parse_content(text, file);
          const std::string checksum = content.at("checksum");
          content.erase("checksum");
          if (checkpoint_checksum::of_text(content.dump()) != checksum)
            throw InputError("", file + ": damaged: its checksum is wrong");
          const Json &found = content.at("format");
          if (found != format_version)
            throw InputError("",
                             fmt::format("{}: found a checkpoint of format "
                                         "{}; allowed: {}, that of this "
                                         "program",
                                         file,
                                         found.dump(),
                                         format_version));
          if (!has_all_parts(content))
            throw InputError("", file + ": damaged: it is no whole checkpoint");
          return content;
        }
      catch (const Json::exception &)
        {
          throw InputError("", file + ": damaged: it is no whole checkpoint");
        }
    }
  } // namespace

  CheckpointWriter::CheckpointWriter(const std::string    &path,
                                     const Discretization &discretization,
                                     const FileOrder      &order)
    : path(path)
    , discretization(discretization)
    , order(order)
    , file(path + ".h5", discretization.communicator())
    , values(Json::object())
  {}

  void
  CheckpointWriter::transfer(const std::string &name, std::string &text)
  {
    values[section + name] = text;
  }

  void
  CheckpointWriter::transfer(const std::string &name, Vector &vector)
  {
    const std::string full_name = section + name;
    if (vector.size() == 0)
      values[full_name] = "empty";
    else if (has_no_bits(vector))
      // Such as velocities in statics.
      values[full_name] = "zero";
    else
      {
        values[full_name] = "stored";
        order.write(file, table_name(full_name), vector.begin(), 3);
      }
  }

  void
  CheckpointWriter::finish(const Json &parameters, const bool durable)
  {
    const MPI_Comm comm = discretization.communicator();
    file.finish(durable);
    const FileContent vectors_file = content_of_file(path + ".h5", comm);
    const std::string mesh         = mesh_checksum(discretization.mesh());
    on_root(comm, [&] {
      Json content;
      content["format"]           = format_version;
      content["version"]          = version;
      content["git_revision"]     = git_revision;
      content["cells"]            = discretization.n_global_cells();
      content["nodes"]            = discretization.n_global_nodes();
      content["mesh_checksum"]    = mesh;
      content["vectors_size"]     = vectors_file.size;
      content["vectors_checksum"] = vectors_file.checksum;
      content["parameters"]       = parameters;
      content["values"]           = values;
      content["checksum"] = checkpoint_checksum::of_text(content.dump());
      try
        {
          write_whole_file(path + ".json",
                           content.dump(1) + "\n",
                           "the checkpoint",
                           durable);
        }
      catch (const MachineError &)
        {
          // The file is of no use alone, and would take the room of the next
          // one.
          std::error_code error;
          std::filesystem::remove(path + ".h5", error);
          throw;
        }
    });
  }

  CheckpointReader::CheckpointReader(const std::string    &path,
                                     const Discretization &discretization,
                                     const FileOrder      &order)
    : path(path)
    , discretization(discretization)
    , order(order)
  {
    const MPI_Comm comm = discretization.communicator();
    content             = Json::parse(
      from_root(comm, [&] { return read_content(path + ".json").dump(); }));
    if (!from_root(comm, [&] { return std::filesystem::exists(path + ".h5"); }))
      fail(".h5: damaged: there is no such file");
    const FileContent found = content_of_file(path + ".h5", comm);
    if (found.size != content.at("vectors_size").get<std::uint64_t>())
      fail(fmt::format(".h5: damaged: found {} bytes; needed are {}",
                       found.size,
                       content.at("vectors_size").get<std::uint64_t>()));
    if (found.checksum != content.at("vectors_checksum").get<std::string>())
      fail(".h5: damaged: its checksum is wrong");
  }

  void
  CheckpointReader::check_mesh() const
  {
    const std::string found = mesh_checksum(discretization.mesh());
    const std::size_t cells = content.at("cells");
    if (cells != discretization.n_global_cells())
      throw InputError(
        "Mesh/Type",
        fmt::format("--restart: found a mesh of {} cells that is "
                    "not that of the checkpoint {}.json, which "
                    "has {}; allowed: the same",
                    discretization.n_global_cells(),
                    path,
                    cells));
    if (content.at("mesh_checksum") != found)
      throw InputError(
        "Mesh/Type",
        fmt::format("--restart: found a mesh that is not that of the "
                    "checkpoint {}.json: it has as many cells, {}, but other "
                    "vertices, vertices of cells, regions or boundaries; "
                    "allowed: the same",
                    path,
                    cells));
  }

  void
  CheckpointReader::fail(const std::string &problem) const
  {
    throw InputError("", path + problem);
  }

  void
  CheckpointReader::transfer(const std::string &name, std::string &text)
  {
    const Json       &values = content.at("values");
    const std::string key    = section + name;
    if (!values.contains(key))
      fail(".json: has no value of '" + key + "'");
    text = values.at(key);
  }

  void
  CheckpointReader::transfer(const std::string &name, Vector &vector)
  {
    std::string kind;
    transfer(name, kind);
    if (kind == "empty")
      {
        vector.reinit(0);
        return;
      }
    discretization.initialize_vector(vector);
    if (kind == "zero")
      return;
    const Hdf5Rows      rows  = order.rows(3);
    const std::string   table = table_name(section + name);
    std::vector<double> numbers;
    on_all_ranks(discretization.communicator(), [&] {
      const Hdf5Tables tables(path + ".h5");
      const hsize_t    n = tables.n_rows(table, 3);
      if (n != rows.n_global_rows)
        fail(fmt::format(".h5: table '{}' has {} rows; needed are {}",
                         table,
                         n,
                         rows.n_global_rows));
      numbers = tables.read<double>(table, rows);
    });
    order.from_file(numbers.data(), vector.begin(), 3);
  }
} // namespace corotet
