// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Runs the program on request, each time in a new child of this process, which
// has loaded the program's two hundred or so libraries once: that takes most of
// the time of a short run. This process has done nothing else before, so a
// child behaves like the program itself.
//
// Requests are lines of JSON on standard input: "arguments" (the first is the
// program's name), "folder" (where to run), "output" and "errors" (files for
// the child's standard output and errors), "timeout" in seconds, "memory", a
// limit in bytes or 0, "environment" (further variables). The answer to each is
// a line of JSON on standard output: "status", the exit status, or minus the
// signal that ended the child, and "seconds" of processor time. support.py
// asks.

#include <corotet/studies/program.h>

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

namespace
{
  void
  redirect(const std::string &file, const int flags, const int descriptor)
  {
    const int opened = open(file.c_str(), flags, 0600);
    if (opened < 0 || dup2(opened, descriptor) < 0)
      _exit(127);
    close(opened);
  }



  // Runs the program in the child, and ends it as main() would.
  [[noreturn]] void
  run(const nlohmann::json &request)
  {
    redirect("/dev/null", O_RDONLY, STDIN_FILENO);
    redirect(request.at("output"), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
    redirect(request.at("errors"), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
    if (chdir(request.at("folder").get<std::string>().c_str()) != 0)
      _exit(127);
    for (const auto &[name, value] : request.at("environment").items())
      setenv(name.c_str(), value.get<std::string>().c_str(), 1);
    if (const rlim_t memory = request.at("memory"); memory != 0)
      {
        const rlimit limit{memory, memory};
        setrlimit(RLIMIT_AS, &limit);
      }
    alarm(request.at("timeout").get<unsigned int>());

    static auto words = request.at("arguments").get<std::vector<std::string>>();
    std::vector<char *> arguments;
    for (std::string &word : words)
      arguments.push_back(word.data());
    arguments.push_back(nullptr);
    std::exit(
      corotet::run_program(static_cast<int>(words.size()), arguments.data()));
  }
} // namespace



int
main()
{
  for (std::string line; std::getline(std::cin, line);)
    {
      const nlohmann::json request = nlohmann::json::parse(line);
      const pid_t          child   = fork();
      if (child == 0)
        run(request);
      int    status = 0;
      rusage usage{};
      if (child < 0 || wait4(child, &status, 0, &usage) != child)
        return 1;
      const double seconds =
        usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
        1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
      const int end =
        WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
      std::cout << nlohmann::json{{"status", end}, {"seconds", seconds}}.dump()
                << std::endl;
    }
}
