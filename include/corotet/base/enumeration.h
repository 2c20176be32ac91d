// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_enumeration_h
#define corotet_base_enumeration_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>

#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The values of an enumeration that a parameter may have, with the names that
   * parameter files use for them.
   */
  template <typename Enum>
  using Enumeration = std::vector<std::pair<std::string, Enum>>;

  template <typename Enum>
  const std::string &
  name_of(const Enumeration<Enum> &values, const Enum value)
  {
    for (const auto &[name, candidate] : values)
      if (candidate == value)
        return name;
    AssertThrow(false, dealii::ExcMessage("A value without a name"));
    return values.front().first;
  }

  /// The pattern of the names: "a|b|c".
  template <typename Enum>
  dealii::Patterns::Selection
  selection(const Enumeration<Enum> &values)
  {
    std::string names;
    for (const auto &[name, value] : values)
      names += (names.empty() ? "" : "|") + name;
    return dealii::Patterns::Selection(names);
  }

  /**
   * Declares an entry whose value is one of @p values, by default the present
   * value of @p value. When @p prm reads another value it sets @p value.
   */
  template <typename Enum>
  void
  add_enumeration(dealii::ParameterHandler &prm,
                  const std::string        &entry,
                  Enum                     &value,
                  const Enumeration<Enum>  &values,
                  const std::string        &documentation)
  {
    prm.declare_entry(entry,
                      name_of(values, value),
                      selection(values),
                      documentation);
    prm.add_action(entry, [&value, values](const std::string &text) {
      for (const auto &[name, candidate] : values)
        if (name == text)
          value = candidate;
    });
  }
} // namespace corotet

#endif
