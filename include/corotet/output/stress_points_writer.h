// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_stress_points_writer_h
#define corotet_output_stress_points_writer_h

#include <corotet/output/file_order.h>
#include <corotet/output/series_writer.h>

#include <optional>
#include <string>

namespace corotet
{
  /**
   * Writes stress as it was computed: stress_points.vtkhdf, a time series with
   * a vertex (cell type 1) at the position at rest of each point of each cell's
   * stiffness rule, with displacement, stress and strain there. Its states are
   * those of the VtkhdfWriter with the same time between results.
   */
  class StressPointsWriter : public SeriesWriter
  {
  public:
    /// The arguments are those of VtkhdfSeries.
    StressPointsWriter(const std::string &directory,
                       const double       time_between_results,
                       const std::size_t  n_joined = 32);

  private:
    void
    write_mesh(const Snapshot &state) override;
    void
    write_tables(Hdf5File &file, const Snapshot &state) override;

    /// The order of the cells, from start() on, and the number of points of a
    /// cell.
    std::optional<FileOrder> cells;
    hsize_t                  n_points = 0;
  };
} // namespace corotet

#endif
