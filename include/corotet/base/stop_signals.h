// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_stop_signals_h
#define corotet_base_stop_signals_h

#include <csignal>

namespace corotet
{
  /// From now on, writing to a pipe without a reader does not end the process:
  /// readers may stop, as `head` does, or end first when both get a signal.
  void
  ignore_closed_pipes();

  /**
   * Handles signals during its lifetime: SIGTERM, SIGINT, SIGHUP (the terminal
   * was closed) and SIGXCPU (the limit of CPU time) are remembered instead of
   * ending the process, and so is SIGUSR1, a request to save. A second SIGINT
   * ends the process at once. SIGHUP is left alone where it would not end the
   * process, as with nohup. An object that lives within the lifetime of another
   * one changes nothing.
   */
  class StopSignals
  {
  public:
    StopSignals();
    ~StopSignals();

    StopSignals(const StopSignals &) = delete;
    StopSignals &
    operator=(const StopSignals &) = delete;

    /// The stop signal (one of the first four above) that this process has
    /// received; 0 if there was none.
    static int
    received();

    /// The time since the stop signal was received [s]; 0 if there was none.
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
