// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/obstacle_writer.h>

#include <deal.II/base/mpi.h>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  ObstacleWriter::ObstacleWriter(
    const std::vector<std::shared_ptr<const Obstacle>> &obstacles,
    const std::string                                  &directory,
    const double                                        time_between_results,
    const std::size_t                                   n_joined)
    : SeriesWriter(
        VtkhdfSeries(directory, "obstacles", time_between_results, n_joined))
    , obstacles(obstacles)
  {
    series.point_data       = {{"displacement", 3}};
    series.static_cell_data = {"obstacle", "hollow"};
  }

  void
  ObstacleWriter::write_mesh(const Snapshot &state)
  {
    const MPI_Comm comm       = state.discretization.communicator();
    const auto [lower, upper] = state.discretization.bounding_box();
    const Point<3> middle     = lower + 0.5 * (upper - lower);
    const double   length     = lower.distance(upper);

    // All ranks make the few triangles, rank 0 writes them.
    std::vector<double>       positions;
    std::vector<std::int64_t> connectivity, offsets{0}, numbers, hollow;

    n_points.clear();
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      {
        const Obstacle::Surface surface = obstacles[o]->surface(middle, length);
        const std::int64_t      first   = positions.size() / 3;
        for (const Point<3> &x : surface.points)
          positions.insert(positions.end(), {x[0], x[1], x[2]});
        for (const auto &triangle : surface.triangles)
          {
            for (const unsigned int corner : triangle)
              connectivity.push_back(first + corner);
            offsets.push_back(connectivity.size());
            numbers.push_back(o);
            hollow.push_back(obstacles[o]->is_hollow() ? 1 : 0);
          }
        n_points.push_back(surface.points.size());
      }
    series.n_points = positions.size() / 3;
    series.n_cells  = numbers.size();
    // VTK's triangle.
    const std::vector<std::uint8_t> types(numbers.size(), 5);

    Hdf5File file(series.mesh_file(), comm);
    file.write_from_root("Points", positions, 3);
    file.write_from_root("Types", types);
    file.write_from_root("Connectivity", connectivity);
    file.write_from_root("Offsets", offsets);
    file.write_from_root("obstacle", numbers);
    file.write_from_root("hollow", hollow);
    series.write_sizes(file, connectivity.size());
    file.finish();
  }

  void
  ObstacleWriter::write_tables(Hdf5File &file, const Snapshot &state)
  {
    std::vector<double> displacements;
    for (std::size_t o = 0; o < obstacles.size(); ++o)
      {
        const Tensor<1, 3> u = obstacles[o]->displacement(state.record.time);
        for (std::size_t i = 0; i < n_points[o]; ++i)
          displacements.insert(displacements.end(), {u[0], u[1], u[2]});
      }
    const bool is_root = dealii::Utilities::MPI::this_mpi_process(
                           state.discretization.communicator()) == 0;
    file.write("PointData/displacement",
               displacements.data(),
               {0, is_root ? series.n_points : 0, series.n_points, 3});
  }
} // namespace corotet
