// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_operators_any_of_h
#define corotet_source_operators_any_of_h

#include <corotet/operators/force_term.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace corotet
{
  /// Whether @p choice(ForceTerm) is true for any of the terms.
  template <typename Choice>
  bool
  any_of(const std::vector<std::unique_ptr<ForceTerm>> &terms,
         const Choice                                  &choice)
  {
    return std::any_of(terms.begin(), terms.end(), [&](const auto &term) {
      return choice(*term);
    });
  }
} // namespace corotet

#endif
