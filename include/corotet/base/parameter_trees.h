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
  /// Sections in sections: no parameter file needs so many, and readers must
  /// not run out of their stack.
  constexpr int max_section_depth = 20;

  /// What a parameter file may have; none needs a tenth of it. So no file makes
  /// the program want much more memory or time than it is long.
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

  /// Throws it if @p text has a zero byte.
  void
  check_zero_bytes(const std::string &text, const std::string &place);

  /// Throws the one of an entry, or in .json and .xml files a section, that is
  /// in a file twice. @p first: where before, ", first in line N" or nothing.
  [[noreturn]] void
  refuse_second(const std::string &place,
                const std::string &name,
                const std::string &first = "");

  /// Throws the one of a file with more levels.
  [[noreturn]] void
  refuse_as_too_deep(const std::string &place);

  /// Throws the one of a file that has more than max_tree_entries.
  [[noreturn]] void
  refuse_as_too_many(const std::string &path);

  /// The statements of an open .xml or .json file called @p path. Throw
  /// InputError, with the place in the message.
  std::vector<ParameterStatement>
  read_xml_statements(const std::string &path, std::istream &file);
  std::vector<ParameterStatement>
  read_json_statements(const std::string &path, std::istream &file);
} // namespace corotet

#endif
