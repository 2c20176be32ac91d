// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "source_path.h"

namespace corotet::tests
{
  std::string
  source_path(const std::string &name)
  {
    return COROTET_SOURCE_DIR "/" + name;
  }
} // namespace corotet::tests
