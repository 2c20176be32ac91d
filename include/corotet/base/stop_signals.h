// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_stop_signals_h
#define corotet_base_stop_signals_h

#include <csignal>

namespace corotet
{
  /// From now on output that nobody reads any more does not end the process:
  /// readers may stop, as `head` does, or end first at a signal for both.
  void
  ignore_closed_pipes();

  /**
   * While it lives, SIGTERM, SIGINT, SIGHUP, which comes when the terminal is
   * closed, and SIGXCPU, which comes at the limit of CPU time, are remembered
   * instead of ending the process, and so is SIGUSR1, a wish to save. A second
   * SIGINT ends the process at once. SIGHUP is left alone where it
   * would not end the process, as with nohup. What lives within the life of
   * another one changes nothing.
   */
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();

    StopSignals(const StopSignals &) = delete;
    StopSignals &
    operator=(const StopSignals &) = delete;

    /// That of the first four which came to this process; 0 if none did.
    static int
    received();

    /// How long ago it came [s]; 0 if none did.
    static double
    waiting_time();

    /// Whether SIGUSR1 came since the last call.
    static bool
    take_save_request();

  private:
    struct sigaction before_term, before_int, before_hup, before_xcpu,
      before_usr1;
  };
} // namespace corotet

#endif
