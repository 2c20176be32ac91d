// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_page_of_run_h
#define corotet_studies_page_of_run_h

#include <string>

namespace corotet
{
  /// The command that makes the page of a run, as it is to be typed: the
  /// libraries of scripts may be elsewhere.
  std::string
  command_for_page(const std::string &directory);
} // namespace corotet

#endif
