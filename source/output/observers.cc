// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/observers.h>
#include <corotet/output/obstacle_writer.h>
#include <corotet/output/progress.h>
#include <corotet/output/stress_points_writer.h>
#include <corotet/output/summary_writer.h>
#include <corotet/output/vtkhdf_writer.h>

namespace corotet
{
  std::vector<std::unique_ptr<Observer>>
  make_observers(const OutputParameters                             &parameters,
                 const std::string                                  &directory,
                 const HistoryColumns                               &columns,
                 const MPI_Comm                                      comm,
                 const double                                        start_time,
                 const double                                        end_time,
                 Log                                                &log,
                 const std::vector<std::shared_ptr<const Obstacle>> &obstacles)
  {
    const double time_between_states =
      parameters.time_between_states(end_time - start_time);
    auto history = std::make_unique<HistoryWriter>(directory, columns);
    auto summary = std::make_unique<SummaryWriter>(
      directory, *history, comm, parameters.has_stress_at_nodes());

    std::vector<std::unique_ptr<Observer>> observers;
    observers.push_back(std::make_unique<VtkhdfWriter>(
      directory, time_between_states, 32, parameters.has_stress_at_nodes()));
    if (parameters.has_stress_at_points())
      observers.push_back(
        std::make_unique<StressPointsWriter>(directory, time_between_states));
    if (!obstacles.empty())
      observers.push_back(std::make_unique<ObstacleWriter>(
        obstacles, directory, time_between_states));
    observers.push_back(std::move(history));
    observers.push_back(std::move(summary));
    observers.push_back(std::make_unique<Progress>(start_time, end_time, log));
    return observers;
  }
} // namespace corotet
