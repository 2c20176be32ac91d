// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_source_path_h
#define corotet_tests_source_path_h

#include <string>

namespace corotet::tests
{
  /// The absolute path of a file or folder of the sources, e.g. "meshes".
  std::string
  source_path(const std::string &name);
} // namespace corotet::tests

#endif
