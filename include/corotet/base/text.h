// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_text_h
#define corotet_base_text_h

#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace corotet
{
  /**
   * The candidate that differs from @p word by the fewest inserted, removed or
   * replaced characters (Levenshtein distance, whatever the case); the first of
   * several equally near. Empty if none is near: more than a third of the
   * characters, but at least one, would have to change.
   */
  std::string
  nearest(const std::string &word, const std::vector<std::string> &candidates);

  /**
   * The parts, one after another, with @p separator between them.
   */
  std::string
  join(const std::vector<std::string> &parts,
       const std::string              &separator = ", ");

  /// A text with its ASCII letters in upper case.
  std::string
  upper_case(const std::string_view text);

  /// The name, or if it is taken "NAME (2)", "NAME (3)" and so on.
  template <typename IsTaken>
  std::string
  unused_name(const std::string &name, const IsTaken &is_taken)
  {
    std::string result = name;
    for (unsigned int i = 2; is_taken(result); ++i)
      result = name + " (" + std::to_string(i) + ")";
    return result;
  }

  /// The finite number that a whole word is, whatever the locale; a plus sign
  /// and Fortran's exponents, "1.D-3", are accepted, as some programs write
  /// them.
  std::optional<double>
  parse_number(const std::string_view word);

  /// The UTF-8 byte order mark, which some editors write at the start of a
  /// file.
  inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

  /// Skips a byte order mark at the start of @p file.
  void
  skip_byte_order_mark(std::istream &file);

  /// A text of any length shortened for a message: if it is longer than @p most
  /// bytes, its start and its length.
  std::string
  shortened(const std::string &text, const std::size_t most = 80);

  /// A message for a terminal, with control characters as \\xNN (line ends and
  /// tabs, too, unless @p keep_lines), other characters that are invisible or
  /// look like a space or a hyphen as <U+NNNN>, and at most a few thousand
  /// characters.
  std::string
  printable(const std::string &message, const bool keep_lines = false);

  /**
   * The parts of @p text between separators outside of (), [] and of names in
   * quotes, without white space around them. A text without separator is one
   * part; an empty text is one empty part.
   */
  std::vector<std::string>
  split_outside_brackets(const std::string &text, const char separator);
} // namespace corotet

#endif
