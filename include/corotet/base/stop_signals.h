// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_stop_signals_h
#define corotet_base_stop_signals_h

#include <csignal>

namespace corotet
{
  /**
   * While it lives, SIGTERM and SIGINT are remembered instead of ending the
   * process, and so is SIGUSR1, a wish to save. A second SIGINT or SIGTERM ends
   * the process at once. Not more than one at a time.
   */
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();

    StopSignals(const StopSignals &) = delete;
    StopSignals &
    operator=(const StopSignals &) = delete;

    /// SIGTERM or SIGINT, whichever came to this process; 0 if none did.
    static int
    received();

    /// Whether SIGUSR1 came since the last call.
    static bool
    take_save_request();

  private:
    struct sigaction before_term, before_int, before_usr1;
  };
} // namespace corotet

#endif
