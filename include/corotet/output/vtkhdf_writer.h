// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_vtkhdf_writer_h
#define corotet_output_vtkhdf_writer_h

#include <corotet/discretization/coarser_nodes.h>
#include <corotet/output/file_order.h>
#include <corotet/output/series_writer.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The nodes of VTK's Lagrange tetrahedron (cell type 71): element i is the
   * number in FE_SimplexP(@p degree) of VTK's node i. Degrees 1, 2, 3.
   *
   * VTK's order: vertices; edges 01, 12, 20, 03, 13, 23, each from its first
   * to its second vertex; faces 013, 123, 023, 012.
   */
  std::vector<unsigned int>
  vtk_node_order(const unsigned int degree);

  /**
   * Writes the time series for ParaView: solution.vtkhdf, a temporal
   * UnstructuredGrid of VTKHDF 2.0 with Lagrange tetrahedra of the run's own
   * degree. For an element with bubbles only the nodes on vertices and edges
   * are written: the quadratic interpolant of the solution.
   *
   * VtkhdfSeries describes how the series is stored.
   */
  class VtkhdfWriter : public SeriesWriter
  {
  public:
    /// The arguments are those of VtkhdfSeries; with @p with_stress the series
    /// also has the recovered stress at nodes and the estimate of its error.
    VtkhdfWriter(const std::string &directory,
                 const double       time_between_results,
                 const std::size_t  n_joined    = 32,
                 const bool         with_stress = false);

  private:
    void
    write_mesh(const Snapshot &state) override;
    void
    write_tables(Hdf5File &file, const Snapshot &state) override;
    void
    write_connectivity(const Nodes &shown, Hdf5File &file);
    /// Writes the values at the nodes that are written. Collective.
    void
    write_nodal(Hdf5File &file, const std::string &name, const Vector &values);
    void
    write_stress(Hdf5File &file, StressField &stress) const;

    bool with_stress;

    /// The nodes that are written, if these are not all nodes.
    std::unique_ptr<CoarserNodes> without_bubbles;
    /// The order of the written nodes, and of the cells; from start() on.
    std::optional<FileOrder> nodes;
    std::optional<FileOrder> cells;
  };
} // namespace corotet

#endif
