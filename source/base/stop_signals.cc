// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/stop_signals.h>

#include <atomic>
#include <chrono>

namespace corotet
{
  namespace
  {
    volatile std::sig_atomic_t stop_signal  = 0;
    volatile std::sig_atomic_t save_request = 0;
    // The time when the stop signal came.
    std::atomic<std::chrono::steady_clock::rep> stop_time = 0;
    static_assert(decltype(stop_time)::is_always_lock_free);
    // The number of living StopSignals objects.
    int depth = 0;

    void
    remember(const int signal)
    {
      if (signal == SIGUSR1)
        {
          save_request = 1;
          return;
        }
      // Only a second SIGINT ends the process: launchers may hand on SIGTERM
      // more than once, but a user who types Ctrl-C again does not want to
      // wait.
      if (signal == SIGINT && stop_signal == SIGINT)
        {
          // Files that are complete stay complete, whatever is being written.
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      if (stop_signal == 0)
        stop_time = std::chrono::steady_clock::now().time_since_epoch().count();
      if (stop_signal == 0 || signal == SIGINT)
        stop_signal = signal;
    }
  } // namespace

  void
  ignore_closed_pipes()
  {
    std::signal(SIGPIPE, SIG_IGN);
  }

  StopSignals::StopSignals()
  {
    if (depth++ > 0)
      return;
    stop_signal  = 0;
    save_request = 0;
    struct sigaction action{};
    action.sa_handler = remember;
    sigemptyset(&action.sa_mask);
    // Interrupted reads and writes continue.
    action.sa_flags = SA_RESTART;
    sigaction(SIGTERM, &action, &before_term);
    sigaction(SIGINT, &action, &before_int);
    sigaction(SIGHUP, nullptr, &before_hup);
    if (before_hup.sa_handler == SIG_DFL)
      sigaction(SIGHUP, &action, nullptr);
    sigaction(SIGXCPU, &action, &before_xcpu);
    sigaction(SIGUSR1, &action, &before_usr1);
  }

  StopSignals::~StopSignals()
  {
    if (--depth > 0)
      return;
    sigaction(SIGTERM, &before_term, nullptr);
    sigaction(SIGINT, &before_int, nullptr);
    sigaction(SIGHUP, &before_hup, nullptr);
    sigaction(SIGXCPU, &before_xcpu, nullptr);
    sigaction(SIGUSR1, &before_usr1, nullptr);
  }

  int
  StopSignals::received()
  {
    return stop_signal;
  }

  double
  StopSignals::waiting_time()
  {
    using Clock = std::chrono::steady_clock;
    if (stop_signal == 0)
      return 0;
    const Clock::time_point came(Clock::duration(stop_time.load()));
    return std::chrono::duration<double>(Clock::now() - came).count();
  }

  bool
  StopSignals::take_save_request()
  {
    const bool was_requested = save_request != 0;
    save_request             = 0;
    return was_requested;
  }
} // namespace corotet
