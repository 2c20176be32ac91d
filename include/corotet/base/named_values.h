// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_named_values_h
#define corotet_base_named_values_h

#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The pairs of a list "name: value, name: value", separated by commas outside
   * of brackets; none if @p text is empty. Throws an InputError that blames @p
   * entry for an item without colon.
   */
  std::vector<std::pair<std::string, std::string>>
  named_values(const std::string &text, const std::string &entry);
} // namespace corotet

#endif
