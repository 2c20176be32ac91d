// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Runs the target that COROTET_FUZZ_TARGET names on every file of the folders
// given, and with --mutate SECONDS on mutations of them (always the same ones).
// Each input has limits: ten times its size and 100 MB of memory, and 10 s. One
// that breaks them or the target is named, and kept in the current folder.

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <exception>
#include <iostream>
#include <iterator>
#include <random>
#include <vector>

#include "targets.h"

extern "C" int
LLVMFuzzerInitialize(int *argc, char ***argv);
extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size);

namespace
{
  constexpr unsigned int max_seconds = 10;

  // The current input and its name, for the handler of signals.
  std::string input;
  std::string name;

  // Keeps the input that has failed, using only functions that a handler of
  // signals may call.
  void
  keep_input(const char *reason)
  {
    const int  file = open("fuzz.finding", O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const bool kept = file >= 0 && write(file, input.data(), input.size()) ==
                                     static_cast<ssize_t>(input.size());
    for (const char *part : {"fuzz: ",
                             name.c_str(),
                             ": ",
                             reason,
                             kept ? "; the input is in fuzz.finding\n" :
                                    "; the input could not be kept\n"})
      if (write(STDERR_FILENO, part, std::strlen(part)) < 0)
        break;
  }

  void
  handle_signal(const int signal)
  {
    keep_input(signal == SIGALRM ? "it takes too long" : strsignal(signal));
    _exit(1);
  }

  // Signals are caught also where the stack is exhausted.
  void
  catch_signals()
  {
    static std::vector<char> stack(1 << 16);
    stack_t                  other{};
    other.ss_sp   = stack.data();
    other.ss_size = stack.size();
    sigaltstack(&other, nullptr);
    struct sigaction action{};
    action.sa_handler = handle_signal;
    action.sa_flags   = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGALRM})
      sigaction(signal, &action, nullptr);
  }

  // The private writable memory, which RLIMIT_DATA counts.
  [[maybe_unused]] std::uint64_t
  data_size()
  {
    std::ifstream file("/proc/self/statm");
    std::uint64_t pages[6] = {};
    for (std::uint64_t &number : pages)
      file >> number;
    return pages[5] * sysconf(_SC_PAGESIZE);
  }

  // Limits the memory; not with sanitizers, which take memory of their own.
  void
  limit_memory([[maybe_unused]] const std::size_t size)
  {
#if !defined(__SANITIZE_ADDRESS__)
    rlimit limits{};
    getrlimit(RLIMIT_DATA, &limits);
    limits.rlim_cur =
      std::min<rlim_t>(data_size() + 100'000'000 + 10 * size, limits.rlim_max);
    setrlimit(RLIMIT_DATA, &limits);
#endif
  }

  bool
  run(const std::string &what, const std::string &bytes)
  {
    name  = what;
    input = bytes;
    limit_memory(input.size());
    alarm(max_seconds);
    try
      {
        LLVMFuzzerTestOneInput(
          reinterpret_cast<const std::uint8_t *>(input.data()), input.size());
        alarm(0);
        return true;
      }
    catch (const std::bad_alloc &)
      {
        keep_input("it takes too much memory");
      }
    catch (const std::exception &error)
      {
        keep_input(error.what());
      }
    return false;
  }

  // One of the inputs with one to eight changes of bytes or pieces.
  std::string
  mutated(const std::vector<std::string> &inputs, std::mt19937 &random)
  {
    const auto below = [&](const std::size_t n) -> std::size_t {
      return n == 0 ? 0 : random() % n;
    };
    std::string bytes = inputs[below(inputs.size())];
    for (std::size_t n = 1 + below(8); n > 0; --n)
      {
        const std::size_t place = below(bytes.size() + 1);
        const std::size_t length =
          below(std::min<std::size_t>(64, bytes.size() + 1 - place));
        const std::string &other = inputs[below(inputs.size())];
        switch (below(6))
          {
            case 0:
              if (place < bytes.size())
                bytes[place] = static_cast<char>(random());
              break;
            case 1:
              if (place < bytes.size())
                bytes[place] ^= static_cast<char>(1 << below(8));
              break;
            case 2:
              bytes.erase(place, length);
              break;
            case 3:
              bytes.insert(place, bytes.substr(place, length));
              break;
            case 4:
              bytes.insert(place, 1 + below(100), "([{<-^\0\xff"[below(8)]);
              break;
            default:
              bytes.insert(place,
                           other.substr(below(other.size()), 1 + below(64)));
          }
      }
    return bytes;
  }

  // Runs mutations until the time is over or one fails.
  bool
  mutate(const std::vector<std::string> &inputs, const double seconds)
  {
    using Clock      = std::chrono::steady_clock;
    const auto start = Clock::now();
    // The mutations are always the same, so that a failure can be repeated.
    std::mt19937 random(1);
    std::size_t  n = 0;
    while (std::chrono::duration<double>(Clock::now() - start).count() <
           seconds)
      if (!run("mutation " + std::to_string(++n), mutated(inputs, random)))
        return false;
    std::cout << n << " mutations\n";
    return true;
  }
} // namespace

int
main(int argc, char **argv)
{
  namespace fs = std::filesystem;
  LLVMFuzzerInitialize(&argc, &argv);
  catch_signals();
  double                   seconds = 0;
  std::vector<std::string> inputs;
  bool                     is_good = true;
  for (int i = 1; i < argc; ++i)
    if (std::strcmp(argv[i], "--mutate") == 0 && i + 1 < argc)
      seconds = std::atof(argv[++i]);
    else
      for (const auto &entry : fs::directory_iterator(argv[i]))
        {
          std::ifstream file(entry.path(), std::ios::binary);
          inputs.emplace_back(std::istreambuf_iterator<char>(file),
                              std::istreambuf_iterator<char>());
          is_good = run(entry.path().string(), inputs.back()) && is_good;
        }
  std::cout << inputs.size() << " inputs\n";
  if (inputs.empty())
    {
      std::cerr << "fuzz: there are no inputs\n";
      return 1;
    }
  return is_good && (seconds <= 0 || mutate(inputs, seconds)) ? 0 : 1;
}
