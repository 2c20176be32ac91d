// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_sizes_of_parts_h
#define corotet_studies_sizes_of_parts_h

#include <map>
#include <string>

namespace corotet
{
  /// A remark about parts whose sizes (StudyRun::sizes_of_selected_parts()) in
  /// one run of a study differ from those in an earlier run; empty if all are
  /// the same.
  std::string
  describe_changed_parts(const std::map<std::string, double> &before,
                         const std::map<std::string, double> &now);
} // namespace corotet

#endif
