// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_page_of_run_h
#define corotet_studies_page_of_run_h

#include <string>

namespace corotet
{
  /// The command that makes the page of a run, as a user has to type it. It
  /// includes the command that makes the scripts' libraries available, if there
  /// is one.
  std::string
  command_for_page(const std::string &directory);
} // namespace corotet

#endif
