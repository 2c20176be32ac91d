// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_observers_h
#define corotet_output_observers_h

#include <corotet/base/log.h>
#include <corotet/output/history_writer.h>
#include <corotet/output/output_parameters.h>
#include <corotet/simulation/observer.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  class Obstacle;

  /**
   * All observers of a run, in the order in which they must be called: time
   * series, time series of stress points and of @p obstacles, history, summary,
   * progress. They write into @p directory, which must exist. The run is from
   * @p start_time to @p end_time [s]. @p log must outlive them. Collective.
   */
  std::vector<std::unique_ptr<Observer>>
  make_observers(
    const OutputParameters                             &parameters,
    const std::string                                  &directory,
    const HistoryColumns                               &columns,
    const MPI_Comm                                      comm,
    const double                                        start_time,
    const double                                        end_time,
    Log                                                &log,
    const std::vector<std::shared_ptr<const Obstacle>> &obstacles = {});
} // namespace corotet

#endif
