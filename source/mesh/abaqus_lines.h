// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_abaqus_lines_h
#define corotet_source_mesh_abaqus_lines_h

#include <corotet/base/exceptions.h>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corotet::abaqus
{
  /// The file and line of a piece of input.
  struct Place
  {
    std::string path;
    unsigned    line = 0;

    /// Throws an InputError about the line.
    [[noreturn]] void
    refuse(const std::string &message) const;
  };

  /// The line of a keyword, "*ELEMENT, TYPE=C3D4, ELSET=Body": its name in
  /// capitals, without the asterisk, and its parameters, with names in capitals
  /// and values as they are.
  struct Keyword
  {
    Place                              place;
    std::string                        name;
    std::map<std::string, std::string> parameters;

    bool
    has(const std::string &parameter) const
    {
      return parameters.contains(parameter);
    }

    /// The value of a parameter; empty if it is missing.
    std::string
    value(const std::string &parameter) const;

    /// The value of a parameter. Throws an InputError if it is missing or
    /// empty.
    std::string
    needed(const std::string &parameter) const;
  };

  /// A text without blanks around it, and without quotation marks.
  std::string
  trimmed(const std::string_view text,
          const std::string_view blanks = " \t\r\"");

  Keyword
  parse_keyword(const std::string &line, const Place &place);

  /// The fields of a line, between commas outside of quotation marks, without
  /// an empty field after the last comma.
  std::vector<std::string>
  fields(const std::string &line);

  /// A whole number; none if @p text is anything else.
  std::optional<std::int64_t>
  whole_number(const std::string &text);

  /// A positive whole number. Throws an InputError.
  std::int64_t
  tag(const std::string &text, const Place &place);

  /// A finite number, also with Fortran's exponent D. Throws an InputError.
  double
  number(const std::string &text, const Place &place);
} // namespace corotet::abaqus

#endif
