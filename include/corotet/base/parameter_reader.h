// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_reader_h
#define corotet_base_parameter_reader_h

#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * One statement of a parameter file.
   */
  struct ParameterStatement
  {
    /// "Section/Subsection/Entry", or "Section/Subsection" if there is no
    /// value.
    std::string path;
    /// The new value of the entry; none if the statement only opens a
    /// subsection.
    std::optional<std::string> value;
    /// "FILE:LINE", or "FILE" where lines are unknown.
    std::string place;
    /// In .json and .xml files an empty text is an empty value or a subsection
    /// without content.
    bool may_be_section = false;

    /// Serialization by Boost.
    template <typename Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      bool        has_value = value.has_value();
      std::string text      = value.value_or("");
      archive & path & has_value & text & place & may_be_section;
      value = has_value ? std::optional(text) : std::nullopt;
    }
  };

  /**
   * The statements of a parameter file in their order; whether the entries
   * exist is the caller's matter. The ending of the name says which of
   * deal.II's formats it is in:
   * - .prm: `subsection`, `end`, `set`, `include` (relative to the including
   *   file), comments from # on, lines continued by a backslash;
   * - .json and .xml: as ParameterHandler prints them, in full or short.
   *
   * The files are read here and not by ParameterHandler::parse_input(), because
   * that does not tell where an entry was set, accepts any value that has a
   * brace, and ignores misspelt entries in subsections of .json and .xml files.
   *
   * Throws InputError, with the place in the message, and MachineError if a
   * file is there and cannot be read.
   */
  std::vector<ParameterStatement>
  read_parameter_statements(const std::string &path);

  /**
   * The statement "Section/Subsection/Entry = value" of the command line.
   * Throws InputError.
   */
  ParameterStatement
  parse_override(const std::string &text);
} // namespace corotet

#endif
