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

  /// Throws an InputError at "FILE" or "FILE:LINE".
  [[noreturn]] void
  refuse_statement(const std::string &place, const std::string &message);

  /// Throws the one of an entry, or in .json and .xml files a section, that is
  /// in a file twice. @p first: where before, ", first in line N" or nothing.
  [[noreturn]] void
  refuse_second(const std::string &place,
                const std::string &name,
                const std::string &first = "");

  /// Throws the one of a file with more levels.
  [[noreturn]] void
  refuse_as_too_deep(const std::string &place);

  /// The statements of an open .xml or .json file called @p path. Throw
  /// InputError, with the place in the message.
  std::vector<ParameterStatement>
  read_xml_statements(const std::string &path, std::istream &file);
  std::vector<ParameterStatement>
  read_json_statements(const std::string &path, std::istream &file);
} // namespace corotet

#endif
