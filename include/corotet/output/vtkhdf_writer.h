// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_vtkhdf_writer_h
#define corotet_output_vtkhdf_writer_h

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/output/hdf5_file.h>
#include <corotet/simulation/observer.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Where VTK's Lagrange tetrahedron (cell type 71) has its nodes: element i is
   * the number of VTK's node i in FE_SimplexP(@p degree). Degrees 1, 2, 3.
   *
   * VTK's order: vertices; edges 01, 12, 20, 03, 13, 23, each from its first
   * to its second vertex; faces 013, 123, 023, 012.
   */
  std::vector<unsigned int>
  vtk_node_order(const unsigned int degree);

  /**
   * Writes the time series for ParaView: solution.vtkhdf, a temporal
   * UnstructuredGrid of VTKHDF 2.0 with Lagrange tetrahedra of the run's own
   * degree. Of an element with bubbles the nodes on vertices and edges are
   * written: quadratic interpolation of what was computed.
   *
   * Numbers are in files beside it, solution/mesh.h5 (once) and
   * solution/step_NNNNNN.h5 (one per result, NNNNNN is the step), written by
   * all ranks together. solution.vtkhdf itself refers to them by relative names
   * only (external links and virtual datasets), so the folder can be moved. It
   * is replaced after each result, and each file is complete or absent: so a
   * run that is killed leaves every finished result readable.
   *
   * References cost time, to write and to read, so there must not be one to
   * each of thousands of results: solution/block_NNNNNN.h5 refers to 32 results
   * from that of step NNNNNN on, solution/block_2_NNNNNN.h5 to 32 of such
   * blocks, and so on.
   */
  class VtkhdfWriter : public Observer
  {
  public:
    /**
     * Writes into @p directory. A result follows the first step at or after
     * each multiple of @p time_between_results [s] (0: every step); the first
     * and the last state are always written. @p n_joined blocks make a larger
     * one.
     */
    VtkhdfWriter(const std::string &directory,
                 const double       time_between_results,
                 const std::size_t  n_joined = 32);

    /// Throws MachineError if a file cannot be written, as does step().
    void
    start(const Snapshot &initial) override;

    void
    step(const Snapshot &state) override;

    void
    save(const Snapshot &state) override;

  private:
    /// A file in folder solution that has or refers to the numbers of @p
    /// n_results results in a row; @p step is the step of the first.
    struct Block
    {
      unsigned int level;
      unsigned int step;
      std::size_t  n_results;

      std::string
      file_name() const;
    };

    bool
    is_due(const double time) const;

    void
    write_mesh(const Discretization &discretization);
    void
    write_connectivity(const Nodes &shown, Hdf5File &file);
    /// Writes the values at the nodes that are shown. Collective.
    void
    write_nodal(Hdf5File &file, const std::string &name, const Vector &values);
    void
    write_state(const Snapshot &state);
    /// Replaces the last blocks by one, as long as there are enough of the same
    /// level. On rank 0.
    void
    join_blocks();
    /// Writes solution.vtkhdf. On rank 0.
    void
    write_index() const;
    void
    write_index_steps(Hdf5File &file) const;
    /// Writes the tables that stand for those of all blocks from number @p
    /// first_block on, into groups (with a slash at the end, or empty); @p
    /// folder is that of the blocks relative to the file's.
    void
    write_references(Hdf5File          &file,
                     const std::size_t  first_block,
                     const std::string &folder,
                     const std::string &point_group,
                     const std::string &cell_group) const;

    std::string directory;
    double      time_between_results;
    std::size_t n_joined;

    /// The nodes that are shown if these are not all.
    std::unique_ptr<CoarserNodes> without_bubbles;
    /// This rank's share of the nodes (three columns) and of the cells.
    Hdf5Rows nodes{};
    Hdf5Rows cells{};

    /// Of all results so far.
    std::vector<double> times;
    std::vector<Block>  blocks;
  };
} // namespace corotet

#endif
