// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_preconditioner_names_h
#define corotet_tests_solvers_preconditioner_names_h

#include <corotet/solvers/preconditioners.h>

#include <algorithm>
#include <string>
#include <vector>

namespace corotet::tests
{
  /// The preconditioners that this build has: some need optional parts.
  inline std::vector<std::string>
  preconditioner_names()
  {
    std::vector<std::string> names;
    for (const auto &candidate : preconditioners())
      names.push_back(candidate.name);
    return names;
  }

  inline bool
  has_preconditioner(const std::string &name)
  {
    const std::vector<std::string> names = preconditioner_names();
    return std::find(names.begin(), names.end(), name) != names.end();
  }
} // namespace corotet::tests

#endif
