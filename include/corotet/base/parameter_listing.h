// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_listing_h
#define corotet_base_parameter_listing_h

#include <nlohmann/json_fwd.hpp>

#include <ostream>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A deal.II pattern in words: "[Double 0...MAX_DOUBLE (inclusive)]" is "a
   * number >= 0". Unknown patterns are returned as they are.
   */
  std::string
  describe_pattern(const std::string &description);

  /// What the pattern of an entry allows, for a message about a @p value that
  /// does not match. The upper limit of a whole number is mentioned only if the
  /// value exceeds it.
  std::string
  allowed_instead(const std::string &value, const std::string &description);

  /// The names that a deal.II pattern allows to choose from; empty if the
  /// pattern is of another kind.
  std::vector<std::string>
  selection_names(const std::string &description);

  /**
   * Whether a node of a ParameterHandler's JSON tree is an entry (not a
   * subsection, not an alias).
   */
  bool
  is_entry(const nlohmann::ordered_json &node);

  /**
   * Whether a node of a ParameterHandler's JSON tree is a subsection.
   */
  bool
  is_section(const nlohmann::ordered_json &node);

  /**
   * Prints a ParameterHandler's JSON tree as a parameter file; if @p
   * documented, with the meaning of each entry and its allowed values above it.
   */
  void
  print_prm(const nlohmann::ordered_json &tree,
            const bool                    documented,
            std::ostream                 &out);

  /**
   * Prints a ParameterHandler's JSON tree as JSON that can be read as a
   * parameter file: value, default_value, documentation, pattern_description
   * and allowed (the pattern in words) of each entry.
   */
  void
  print_json(const nlohmann::ordered_json &tree, std::ostream &out);

  /**
   * Prints a ParameterHandler's JSON tree as Markdown: a table per section.
   */
  void
  print_markdown(const nlohmann::ordered_json &tree, std::ostream &out);
} // namespace corotet

#endif
