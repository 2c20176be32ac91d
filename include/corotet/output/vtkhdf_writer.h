// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_vtkhdf_writer_h
#define corotet_output_vtkhdf_writer_h

#include <corotet/output/hdf5_file.h>
#include <corotet/simulation/observer.h>

#include <map>
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
   * degree.
   *
   * Numbers are in files beside it, solution/mesh.h5 (once) and
   * solution/step_NNNNNN.h5 (one per result, NNNNNN is the step); each is
   * written by all ranks together and is complete or absent. solution.vtkhdf
   * itself refers to them by relative names only (external links and virtual
   * datasets), so the folder can be moved; it is replaced as a whole after each
   * result. So a run that is killed leaves every finished result readable.
   */
  class VtkhdfWriter : public Observer
  {
  public:
    /**
     * Writes into @p directory. A result follows the first step at or after
     * each multiple of @p time_between_results [s] (0: every step); the first
     * and the last state are always written.
     */
    VtkhdfWriter(const std::string &directory,
                 const double       time_between_results);

    /// Throws MachineError if a file cannot be written, as does step().
    void
    start(const Snapshot &initial) override;

    void
    step(const Snapshot &state) override;

  private:
    bool
    is_due(const double time) const;

    void
    write_mesh(const Discretization &discretization);
    void
    write_connectivity(const Discretization &discretization, Hdf5File &file);
    void
    write_state(const Snapshot &state);
    void
    write_index(const MPI_Comm comm) const;
    void
    write_index_steps(Hdf5File &file) const;

    std::string directory;
    double      time_between_results;

    /// This rank's share of the nodes (three columns) and of the cells.
    Hdf5Rows nodes{};
    Hdf5Rows cells{};

    /// Of the results so far, and the tables that they make, by name.
    std::vector<double>                     times;
    std::map<std::string, Hdf5VirtualTable> point_data;
    std::map<std::string, Hdf5VirtualTable> cell_data;
  };
} // namespace corotet

#endif
