// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_obstacle_writer_h
#define corotet_output_obstacle_writer_h

#include <corotet/forces/obstacle.h>
#include <corotet/output/series_writer.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * Writes the obstacles as triangles: obstacles.vtkhdf, a time series with
   * their displacement. Its states are those of the VtkhdfWriter with the same
   * time between results.
   */
  class ObstacleWriter : public SeriesWriter
  {
  public:
    /// The last arguments are those of VtkhdfSeries.
    ObstacleWriter(
      const std::vector<std::shared_ptr<const Obstacle>> &obstacles,
      const std::string                                  &directory,
      const double                                        time_between_results,
      const std::size_t                                   n_joined = 32);

  private:
    void
    write_mesh(const Snapshot &state) override;
    void
    write_tables(Hdf5File &file, const Snapshot &state) override;

    const std::vector<std::shared_ptr<const Obstacle>> obstacles;
    /// The number of points of each obstacle, from start() on.
    std::vector<std::size_t> n_points;
  };
} // namespace corotet

#endif
