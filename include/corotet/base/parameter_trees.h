// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_trees_h
#define corotet_base_parameter_trees_h

#include <corotet/base/parameter_reader.h>

#include <istream>
#include <string>
#include <vector>

namespace corotet
{
  /// The largest depth of nested sections, more than any parameter file needs:
  /// recursive readers must not run out of stack.
  constexpr int max_section_depth = 20;

  /// Limits of parameter files, more than ten times what any file needs, so
  /// that no file can make the program need much memory or time.
  constexpr std::size_t max_file_size    = 2'000'000;
  constexpr std::size_t max_statements   = 50'000;
  constexpr std::size_t max_path_length  = 1'000;
  constexpr std::size_t max_tree_entries = 20'000;

  /// Appends a statement. Throws InputError if there are too many, or its path
  /// is too long.
  void
  add_statement(std::vector<ParameterStatement> &statements,
                const ParameterStatement        &statement);

  /// Throws an InputError at "FILE" or "FILE:LINE".
  [[noreturn]] void
  refuse_statement(const std::string &place, const std::string &message);

  /// Throws an InputError at @p place if @p text has a zero byte.
  void
  check_zero_bytes(const std::string &text, const std::string &place);

  /// Throws the InputError about an entry, or in .json and .xml files a
  /// section, that a file has twice. @p first tells the first place: ", first
  /// in line N" or nothing.
  [[noreturn]] void
  refuse_second(const std::string &place,
                const std::string &name,
                const std::string &first = "");

  /// Throws the InputError about a file with more than max_section_depth
  /// levels.
  [[noreturn]] void
  refuse_as_too_deep(const std::string &place);

  /// Throws the InputError about a file with more than max_tree_entries.
  [[noreturn]] void
  refuse_as_too_many(const std::string &path);

  /// The statements of an open .xml or .json file called @p path. Both
  /// functions throw InputError, with the place in the message.
  std::vector<ParameterStatement>
  read_xml_statements(const std::string &path, std::istream &file);
  std::vector<ParameterStatement>
  read_json_statements(const std::string &path, std::istream &file);
} // namespace corotet

#endif
