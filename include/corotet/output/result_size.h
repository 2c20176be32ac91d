// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_result_size_h
#define corotet_output_result_size_h

#include <corotet/base/log.h>
#include <corotet/output/output_parameters.h>
#include <corotet/simulation/body.h>

#include <string>

namespace corotet
{
  /**
   * Warns if the results of a run of so many steps [-] and @p duration seconds
   * (rows of the history and states of the time series) will be larger than the
   * free space on the disk of @p directory, or than 100 GB. Collective.
   */
  void
  warn_of_size(const OutputParameters &parameters,
               const std::string      &directory,
               const Body             &body,
               const double            n_steps,
               const double            duration,
               Log                    &log);
} // namespace corotet

#endif
