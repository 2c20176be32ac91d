// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_stress_points_writer_h
#define corotet_output_stress_points_writer_h

#include <corotet/output/file_order.h>
#include <corotet/output/vtkhdf_series.h>
#include <corotet/simulation/observer.h>

#include <optional>
#include <string>

namespace corotet
{
  /**
   * Writes stress as it was computed: stress_points.vtkhdf, a time series with
   * a vertex (cell type 1) at each point of the stiffness rule of each cell, at
   * its place at rest, with displacement, stress and strain there. Its states
   * are those of the VtkhdfWriter with the same time between results.
   */
  class StressPointsWriter : public Observer
  {
  public:
    /// See VtkhdfSeries.
    StressPointsWriter(const std::string &directory,
                       const double       time_between_results,
                       const std::size_t  n_joined = 32);

    /// Throws MachineError if a file cannot be written, as does step().
    void
    start(const Snapshot &initial) override;

    void
    transfer(Archive &archive) override
    {
      series.transfer(archive);
    }

    void
    resume(const Snapshot &state) override;

    void
    step(const Snapshot &state) override;

    void
    save(const Snapshot &state) override;

  private:
    void
    write_mesh(const Discretization   &discretization,
               const ReferenceElement &reference);
    void
    write_state(const Snapshot &state);

    VtkhdfSeries series;
    /// Of the cells, from start() on, and how many points each has.
    std::optional<FileOrder> cells;
    hsize_t                  n_points = 0;
  };
} // namespace corotet

#endif
