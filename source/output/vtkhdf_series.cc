// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/output/vtkhdf_series.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <regex>
#include <set>
#include <system_error>

namespace corotet
{
  namespace
  {
    // The tables that are stored once, by name: VTK's reader expects them in
    // group VTKHDF.
    const std::vector<std::string> mesh_tables{"NumberOfPoints",
                                               "NumberOfCells",
                                               "NumberOfConnectivityIds",
                                               "Points",
                                               "Connectivity",
                                               "Offsets",
                                               "Types"};
  } // namespace

  VtkhdfSeries::VtkhdfSeries(const std::string &directory,
                             const std::string &name,
                             const double       time_between_results,
                             const std::size_t  n_joined)
    : directory(directory)
    , name(name)
    , time_between_results(time_between_results)
    , n_joined(n_joined)
  {}

  void
  VtkhdfSeries::make_folder(const MPI_Comm comm) const
  {
    on_root(comm, [&] {
      const std::string folder = directory + "/" + name;
      std::error_code   error;
      std::filesystem::create_directories(folder, error);
      if (error)
        throw MachineError(folder +
                           ": the folder cannot be made: " + error.message());
    });
  }

  void
  VtkhdfSeries::write_sizes(Hdf5File     &file,
                            const hsize_t n_connectivity_ids) const
  {
    const auto list = [](const hsize_t number) {
      return std::vector<std::int64_t>{static_cast<std::int64_t>(number)};
    };
    file.write_from_root("NumberOfPoints", list(n_points));
    file.write_from_root("NumberOfCells", list(n_cells));
    file.write_from_root("NumberOfConnectivityIds", list(n_connectivity_ids));
  }

  void
  VtkhdfSeries::write_offsets(Hdf5File       &file,
                              const Hdf5Rows &cells,
                              const hsize_t   n_nodes,
                              const MPI_Comm  comm)
  {
    // There is one entry more than cells: rank 0 writes the leading zero.
    const hsize_t begin =
      dealii::Utilities::MPI::this_mpi_process(comm) == 0 ? 0 : 1;
    std::vector<std::int64_t> offsets;
    offsets.reserve(cells.n_rows + 1);
    for (hsize_t cell = begin; cell <= cells.n_rows; ++cell)
      offsets.push_back((cells.first + cell) * n_nodes);
    file.write("Offsets",
               offsets.data(),
               {cells.first + begin, offsets.size(), cells.n_global_rows + 1});
  }

  void
  VtkhdfSeries::transfer(Archive &archive)
  {
    std::vector<unsigned int> levels, steps;
    std::vector<std::size_t>  n_results;
    for (const DataBlock &block : blocks)
      {
        levels.push_back(block.level);
        steps.push_back(block.step);
        n_results.push_back(block.n_results);
      }
    archive.within(name, [&] {
      archive.transfer("times", times);
      archive.transfer("block_levels", levels);
      archive.transfer("block_steps", steps);
      archive.transfer("block_results", n_results);
      archive.transfer("result_steps", result_steps);
      archive.transfer("result_sizes", result_sizes);
    });
    if (steps.size() != levels.size() || n_results.size() != levels.size() ||
        result_steps.size() != times.size() ||
        result_sizes.size() != times.size())
      throw InputError(
        "",
        fmt::format("a checkpoint has {} levels, {} steps and {} numbers of "
                    "results, and {} times, {} steps and {} sizes of results "
                    "for the files of '{}'; needed are as many of each",
                    levels.size(),
                    steps.size(),
                    n_results.size(),
                    times.size(),
                    result_steps.size(),
                    result_sizes.size(),
                    name));
    blocks.clear();
    for (std::size_t i = 0; i < levels.size(); ++i)
      blocks.push_back({levels[i], steps[i], n_results[i]});
  }

  void
  VtkhdfSeries::resume(const unsigned int step, const MPI_Comm comm)
  {
    on_root(comm, [&] {
      check_files();
      write_index();
      // Files that nothing refers to any more: later results, and blocks with
      // such.
      const std::regex result(R"(step_(\d{6,10})\.h5(\.tmp)?)"),
        block(R"(block_(\d+_)?\d{6,10}\.h5(\.tmp)?)");
      const std::set<std::string>        of_blocks = block_files();
      std::vector<std::filesystem::path> left_over;
      for (const auto &entry :
           std::filesystem::directory_iterator(directory + "/" + name))
        {
          const std::string file = entry.path().filename().string();
          std::smatch       match;
          if (std::regex_match(file, match, result) ?
                std::stoull(match[1]) > step :
                std::regex_match(file, block) && !of_blocks.contains(file))
            left_over.push_back(entry.path());
        }
      for (const auto &path : left_over)
        std::filesystem::remove(path);
    });
  }

  bool
  VtkhdfSeries::is_due(const double time) const
  {
    if (time_between_results == 0)
      return true;
    // A step that ends at a multiple, up to round-off, has reached it.
    const auto interval = [&](const double t) {
      return std::floor(t / time_between_results + 1e-6);
    };
    return interval(time) > interval(times.back());
  }

  std::string
  VtkhdfSeries::result_file(const unsigned int step) const
  {
    return directory + "/" + name + "/" + DataBlock{0, step, 1}.file_name();
  }

  void
  VtkhdfSeries::create_groups(Hdf5File &file, const std::string &parent)
  {
    file.create_group(parent + "PointData");
    file.create_group(parent + "CellData");
  }

  void
  VtkhdfSeries::add_result(const unsigned int step,
                           const double       time,
                           const MPI_Comm     comm)
  {
    times.push_back(time);
    blocks.push_back({0, step, 1});
    result_steps.push_back(step);
    std::size_t size = 0;
    on_root(comm, [&] {
      join_blocks();
      write_index();
      std::error_code error;
      const auto found = std::filesystem::file_size(result_file(step), error);
      size             = error ? 0 : found;
    });
    result_sizes.push_back(size);
  }

  void
  VtkhdfSeries::check_files() const
  {
    const auto refuse = [](const std::string &path,
                           const std::string &found,
                           const std::string &needed) {
      throw MachineError(
        fmt::format("{}: the time series cannot be continued: found {}, needed "
                    "{}",
                    path,
                    found,
                    needed));
    };
    for (std::size_t i = 0; i < times.size(); ++i)
      {
        const std::string path = result_file(result_steps[i]);
        std::error_code   error;
        const auto        size = std::filesystem::file_size(path, error);
        if (error || size != result_sizes[i])
          refuse(path,
                 error ? error.message() : fmt::format("{} bytes", size),
                 fmt::format("are its {} bytes", result_sizes[i]));
      }
    for (const std::string &file : block_files())
      {
        const std::string path = directory + "/" + name + "/" + file;
        if (!std::filesystem::is_regular_file(path))
          refuse(path, "no such file", "is what the run has written");
      }
  }

  std::set<std::string>
  VtkhdfSeries::block_files() const
  {
    std::set<std::string> files;
    std::size_t           first = 0;
    for (const DataBlock &block : blocks)
      {
        std::size_t n = 1;
        for (unsigned int level = 1; level <= block.level; ++level)
          {
            n *= n_joined;
            for (std::size_t i = 0; i < block.n_results; i += n)
              files.insert(
                DataBlock{level, result_steps[first + i], n}.file_name());
          }
        first += block.n_results;
      }
    return files;
  }

  std::string
  VtkhdfSeries::DataBlock::file_name() const
  {
    if (level == 0)
      return fmt::format("step_{:06}.h5", step);
    if (level == 1)
      return fmt::format("block_{:06}.h5", step);
    return fmt::format("block_{}_{:06}.h5", level, step);
  }

  void
  VtkhdfSeries::join_blocks()
  {
    // The levels of blocks never increase from one block to the next.
    while (blocks.size() >= n_joined &&
           blocks[blocks.size() - n_joined].level == blocks.back().level)
      {
        const std::size_t first = blocks.size() - n_joined;
        const DataBlock   joined{blocks[first].level + 1,
                               blocks[first].step,
                               blocks[first].n_results * n_joined};
        Hdf5File file(directory + "/" + name + "/" + joined.file_name(),
                      MPI_COMM_SELF);
        write_references(file, first, "", "");
        // Times and rows of steps are few numbers: copies of them are stored
        // here.
        write_steps(file, n_results_before(first), joined.n_results);
        file.finish();
        blocks.resize(first);
        blocks.push_back(joined);
      }
  }

  void
  VtkhdfSeries::write_references(Hdf5File          &file,
                                 const std::size_t  first_block,
                                 const std::string &folder,
                                 const std::string &parent) const
  {
    create_groups(file, parent);
    std::vector<Hdf5Part> point_parts, cell_parts;
    for (std::size_t i = first_block; i < blocks.size(); ++i)
      {
        const std::string file_name = folder + blocks[i].file_name();
        point_parts.push_back({file_name, blocks[i].n_results * n_points});
        cell_parts.push_back({file_name, blocks[i].n_results * n_cells});
      }
    const auto write = [&](const std::string           &name,
                           const std::vector<Hdf5Part> &parts,
                           const hsize_t                n_columns) {
      file.write_virtual<double>(parent + name, name, parts, n_columns);
    };
    for (const Table &table : point_data)
      write("PointData/" + table.name, point_parts, table.n_columns);
    for (const Table &table : cell_data)
      write("CellData/" + table.name, cell_parts, table.n_columns);
  }

  void
  VtkhdfSeries::write_index() const
  {
    Hdf5File file(directory + "/" + name + ".vtkhdf", MPI_COMM_SELF);
    file.create_group("VTKHDF");
    file.write_number_attribute("VTKHDF", "Version", {2, 0});
    file.write_text_attribute("VTKHDF", "Type", "UnstructuredGrid");
    const std::string folder = name + "/";
    for (const std::string &table : mesh_tables)
      file.link("VTKHDF/" + table, folder + "mesh.h5", table);

    write_references(file, 0, folder, "VTKHDF/");
    for (const std::string &table : static_cell_data)
      file.link("VTKHDF/CellData/" + table, folder + "mesh.h5", table);

    write_index_steps(file);
    file.finish();
  }

  std::size_t
  VtkhdfSeries::n_results_before(const std::size_t block) const
  {
    std::size_t n = 0;
    for (std::size_t i = 0; i < block; ++i)
      n += blocks[i].n_results;
    return n;
  }

  void
  VtkhdfSeries::write_steps(Hdf5File         &file,
                            const std::size_t first,
                            const std::size_t n_results) const
  {
    const auto rows = [&](const hsize_t n_rows) {
      std::vector<std::int64_t> offsets(n_results);
      for (std::size_t i = 0; i < n_results; ++i)
        offsets[i] = (first + i) * n_rows;
      return offsets;
    };
    file.create_group("Steps");
    file.write_from_root("Steps/Values",
                         std::vector<double>(times.begin() + first,
                                             times.begin() + first +
                                               n_results));
    file.write_from_root("Steps/PointRows", rows(n_points));
    file.write_from_root("Steps/CellRows", rows(n_cells));
  }

  void
  VtkhdfSeries::write_index_steps(Hdf5File &file) const
  {
    // Data of results that are in no block yet are in the index itself.
    const std::size_t     n = times.size();
    std::vector<Hdf5Part> parts;
    std::size_t           n_in_blocks = 0;
    for (const DataBlock &block : blocks)
      if (block.level > 0)
        {
          parts.push_back({name + "/" + block.file_name(), block.n_results});
          n_in_blocks += block.n_results;
        }
    write_steps(file, n_in_blocks, n - n_in_blocks);
    if (n > n_in_blocks)
      parts.push_back({".", n - n_in_blocks});

    const std::string steps = "VTKHDF/Steps";
    file.create_group(steps);
    file.write_number_attribute(steps,
                                "NSteps",
                                {static_cast<std::int64_t>(n)});
    file.write_virtual<double>(steps + "/Values", "Steps/Values", parts, 0);

    // The first row of each step's tables: the mesh and its static data have
    // the same rows for all steps.
    file.write_constant(steps + "/NumberOfParts", 1, n);
    file.write_constant(steps + "/PartOffsets", 0, n);
    file.link(steps + "/PointOffsets", steps + "/PartOffsets");
    file.write_constant(steps + "/CellOffsets", 0, n, 1);
    file.link(steps + "/ConnectivityIdOffsets", steps + "/CellOffsets");

    const auto write_offsets = [&](const std::string        &group,
                                   const std::vector<Table> &tables,
                                   const std::string        &rows) {
      file.create_group(group);
      for (const Table &table : tables)
        if (&table == &tables.front())
          file.write_virtual<std::int64_t>(group + table.name, rows, parts, 0);
        else
          file.link(group + table.name, group + tables.front().name);
    };
    write_offsets(steps + "/PointDataOffsets/", point_data, "Steps/PointRows");
    write_offsets(steps + "/CellDataOffsets/", cell_data, "Steps/CellRows");
    for (const std::string &table : static_cell_data)
      file.link(steps + "/CellDataOffsets/" + table, steps + "/PartOffsets");
  }
} // namespace corotet
