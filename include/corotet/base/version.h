// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_version_h
#define corotet_base_version_h

#include <string>

namespace corotet
{
  /// The program's version, MAJOR.MINOR.PATCH.
  extern const std::string version;

  /// The git revision that the program was built from, with "-dirty" if there
  /// were uncommitted changes; "unknown" outside a checkout.
  extern const std::string git_revision;
} // namespace corotet

#endif
