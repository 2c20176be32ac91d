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
  /// The position of the closing quotation mark of a name that begins at @p i
  /// of a list of names such as "a, b"; npos if no quotation begins there, or
  /// it is not closed.
  std::size_t
  end_of_quotes(const std::string &text, const std::size_t i);

  /// A list of the names, separated by commas; names that a list would take for
  /// several get quotation marks.
  std::string
  list_of_names(std::vector<std::string> names);

  /// A name without the quotes that it has in a list, if it has any.
  std::string
  without_quotes(const std::string &name);

  /**
   * The items of a list "name: value, name", separated by commas outside of
   * brackets and of quotes, which names keep; none if @p text is empty.
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

  /// Throws InputError, blamed on @p entry, if @p name cannot begin the name of
  /// a column of results; @p what has it: "a probe".
  void
  check_column_name(const std::string &entry,
                    const std::string &name,
                    const std::string &what);

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
