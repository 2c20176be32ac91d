// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_whole_file_h
#define corotet_base_whole_file_h

#include <string>

namespace corotet
{
  /// Writes a file that is complete or absent. Throws MachineError: @p what
  /// ("the summary") cannot be written.
  void
  write_whole_file(const std::string &path,
                   const std::string &text,
                   const std::string &what);
} // namespace corotet

#endif
