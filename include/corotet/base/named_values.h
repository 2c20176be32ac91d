// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_named_values_h
#define corotet_base_named_values_h

#include <deal.II/base/point.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The items of a list "name: value, name", separated by commas outside of
   * brackets; none if @p text is empty.
   */
  std::vector<std::pair<std::string, std::optional<std::string>>>
  names_and_values(const std::string &text);

  /**
   * The pairs of a list "name: value, name: value", separated by commas outside
   * of brackets; none if @p text is empty. Throws an InputError that blames @p
   * entry for an item without colon and says what is @p allowed.
   */
  std::vector<std::pair<std::string, std::string>>
  named_values(
    const std::string &text,
    const std::string &entry,
    const std::string &allowed = "'boundary: value, boundary: value'");

  /// Throws the InputError, blamed on @p entry, about a list that has the
  /// boundary @p name twice.
  [[noreturn]] void
  refuse_second_boundary(const std::string &entry, const std::string &name);

  /// The point whose coordinates @p text is, "x y z"; none if it is anything
  /// but three finite numbers.
  std::optional<dealii::Point<3>>
  point_of(const std::string &text);
} // namespace corotet

#endif
