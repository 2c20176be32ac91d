// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_sizes_of_parts_h
#define corotet_studies_sizes_of_parts_h

#include <map>
#include <string>

namespace corotet
{
  /// What to say of parts, by their sizes
  /// (StudyRun::sizes_of_selected_parts()), that are not as large in one run of
  /// a study as they were in an earlier one; empty if all are.
  std::string
  describe_changed_parts(const std::map<std::string, double> &before,
                         const std::map<std::string, double> &now);
} // namespace corotet

#endif
