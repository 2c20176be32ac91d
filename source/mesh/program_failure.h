// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_program_failure_h
#define corotet_source_mesh_program_failure_h

#include <corotet/base/exceptions.h>
#include <corotet/base/programs.h>

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <string>

namespace corotet
{
  /// Throws an InputError about the file @p path after a program with @p
  /// library, which should have read it, has ended as @p end tells, without a
  /// mesh. It had @p time_limit seconds, set by the parameter @p
  /// time_limit_entry.
  [[noreturn]] inline void
  refuse_end(const ProgramEnd  &end,
             const std::string &library,
             const std::string &path,
             const double       time_limit,
             const std::string &time_limit_entry)
  {
    if (end.has_exceeded)
      throw InputError(time_limit_entry,
                       fmt::format("{}: {} has not come to an end in {} s",
                                   path,
                                   library,
                                   time_limit));
    std::string what;
    if (end.signal == SIGINT || end.signal == SIGTERM)
      what = "has been interrupted";
    else if (end.signal != 0)
      what = fmt::format("has crashed ({}); is the file damaged?",
                         strsignal(end.signal));
    else
      what = fmt::format("has ended with status {} before it had a mesh",
                         end.status);
    throw InputError("", fmt::format("{}: {} {}", path, library, what));
  }
} // namespace corotet

#endif
