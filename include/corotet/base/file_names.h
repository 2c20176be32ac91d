// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_file_names_h
#define corotet_base_file_names_h

#include <string>

namespace corotet
{
  /// The path of the file @p name, which may be relative to @p folder, without
  /// superfluous steps down and up again. (Behind a symbolic link, a step up
  /// leads elsewhere, so it is kept.)
  std::string
  file_in(const std::string &folder, const std::string &name);
} // namespace corotet

#endif
