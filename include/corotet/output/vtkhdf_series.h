// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_vtkhdf_series_h
#define corotet_output_vtkhdf_series_h

#include <corotet/base/archive.h>
#include <corotet/base/hdf5_file.h>

#include <mpi.h>

#include <set>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A time series for ParaView: NAME.vtkhdf, a temporal UnstructuredGrid of
   * VTKHDF 2.0 with one mesh for all results.
   *
   * The numbers are in files beside it, NAME/mesh.h5 (once) and
   * NAME/step_NNNNNN.h5 (one per result, NNNNNN is the step), which the caller
   * writes, by all ranks together. NAME.vtkhdf itself refers to them by
   * relative names only (external links and virtual datasets), so the folder
   * can be moved. It is replaced after each result, and each file is complete
   * or absent: a run that is killed leaves every finished result readable.
   *
   * Writing and reading references takes time, so there must not be one for
   * each of thousands of results: NAME/block_NNNNNN.h5 refers to 32 results
   * from that of step NNNNNN on, NAME/block_2_NNNNNN.h5 to 32 of such blocks,
   * and so on. Blocks also have the times of their results. So the size of
   * NAME.vtkhdf grows only with the logarithm of the number of results.
   */
  class VtkhdfSeries
  {
  public:
    /// A table of each result, and its number of columns (0: a plain list).
    struct Table
    {
      std::string name;
      hsize_t     n_columns;
    };

    /**
     * Writes into @p directory. A result is due at the first step at or after
     * each multiple of @p time_between_results [s] (0: every step). @p n_joined
     * results or blocks are joined to a larger block.
     */
    VtkhdfSeries(const std::string &directory,
                 const std::string &name,
                 const double       time_between_results,
                 const std::size_t  n_joined);

    /// The tables of each result, with a row per point and per cell.
    std::vector<Table> point_data;
    std::vector<Table> cell_data;
    /// Cell data in the mesh file: lists, the same for all results.
    std::vector<std::string> static_cell_data;
    /// The numbers of points and cells on all ranks.
    hsize_t n_points = 0;
    hsize_t n_cells  = 0;

    /// Makes the folder. Throws MachineError. Collective.
    void
    make_folder(const MPI_Comm comm) const;

    /// The path of the mesh file, which the caller writes once, with Points,
    /// Types, Connectivity, Offsets, the static cell data, and write_sizes().
    std::string
    mesh_file() const
    {
      return directory + "/" + name + "/mesh.h5";
    }

    /// Writes the numbers of points, cells and connectivity ids. Collective.
    void
    write_sizes(Hdf5File &file, const hsize_t n_connectivity_ids) const;

    /// Writes the offsets of a mesh whose cells have @p n_nodes points each; @p
    /// cells are the rows of this rank. Collective.
    static void
    write_offsets(Hdf5File       &file,
                  const Hdf5Rows &cells,
                  const hsize_t   n_nodes,
                  const MPI_Comm  comm);

    bool
    is_due(const double time) const;

    /// Whether @p time is later than the last result.
    bool
    is_new(const double time) const
    {
      return times.empty() || time > times.back();
    }

    /// The path of the file that the caller writes for the result of a step,
    /// with the tables of all points and cells in groups PointData and
    /// CellData.
    std::string
    result_file(const unsigned int step) const;

    /// Makes the groups PointData and CellData. Collective.
    static void
    create_groups(Hdf5File &file, const std::string &parent = "");

    /// Transfers the list of results up to now.
    void
    transfer(Archive &archive);

    /// Restores the series as it was when transfer() wrote it, at step @p step;
    /// later results are removed. Throws MachineError, also if files of results
    /// have changed. Collective.
    void
    resume(const unsigned int step, const MPI_Comm comm);

    /// Adds a complete result to the series. Throws MachineError. Collective.
    void
    add_result(const unsigned int step, const double time, const MPI_Comm comm);

  private:
    /// A file in the folder with the numbers of @p n_results consecutive
    /// results, or with references to them; @p step is the step of the first
    /// one.
    struct DataBlock
    {
      unsigned int level;
      unsigned int step;
      std::size_t  n_results;

      std::string
      file_name() const;
    };

    /// Throws MachineError if a file of a result or a block is missing, or if
    /// the file of a result has another size. Called on rank 0.
    void
    check_files() const;
    /// The names of the files of all blocks, and of the blocks that they refer
    /// to.
    std::set<std::string>
    block_files() const;
    /// Joins the last blocks, as long as there are enough of the same level.
    /// Called on rank 0.
    void
    join_blocks();
    /// The number of results in the blocks before number @p block.
    std::size_t
    n_results_before(const std::size_t block) const;
    /// Writes times and first rows of results in a group Steps. Called on rank
    /// 0.
    void
    write_steps(Hdf5File         &file,
                const std::size_t first,
                const std::size_t n_results) const;
    /// Writes NAME.vtkhdf. Called on rank 0.
    void
    write_index() const;
    void
    write_index_steps(Hdf5File &file) const;
    /// Writes tables that refer to those of all blocks from number @p
    /// first_block on. It makes their groups in @p parent, which ends with a
    /// slash or is empty. @p folder is the folder of the blocks relative to the
    /// file's.
    void
    write_references(Hdf5File          &file,
                     const std::size_t  first_block,
                     const std::string &folder,
                     const std::string &parent) const;

    std::string directory;
    std::string name;
    double      time_between_results;
    std::size_t n_joined;

    /// The times of all results so far.
    std::vector<double>    times;
    std::vector<DataBlock> blocks;
    /// The steps of all results, and the sizes of their files [byte], which
    /// only rank 0 knows.
    std::vector<unsigned int> result_steps;
    std::vector<std::size_t>  result_sizes;
  };
} // namespace corotet

#endif
