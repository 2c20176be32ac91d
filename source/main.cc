// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/studies/program.h>

#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <csignal>

namespace
{
  bool ignores_hangup = false;

  // Whether the program was started to ignore SIGHUP, as by nohup. UCX, which
  // MPI brings, takes the signal for messages about itself as soon as it is
  // loaded. Before that only functions of .preinit_array are called, which
  // should not count on any library: so the kernel itself is asked. Its answer
  // begins with the handler.
  void
  look_at_hangup(int /*argc*/, char ** /*argv*/, char ** /*environment*/)
  {
    static std::array<unsigned long, 16> action{};
    ignores_hangup =
      syscall(SYS_rt_sigaction, SIGHUP, nullptr, action.data(), 8) == 0 &&
      // NOLINTNEXTLINE(performance-no-int-to-ptr)
      reinterpret_cast<void (*)(int)>(action[0]) == SIG_IGN;
  }

  [[gnu::section(".preinit_array"),
    gnu::used]] void (*const first)(int, char **, char **) = look_at_hangup;
} // namespace

int
main(int argc, char **argv)
{
  std::signal(SIGHUP, ignores_hangup ? SIG_IGN : SIG_DFL);
  return corotet::run_program(argc, argv);
}
