// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_refusal_h
#define corotet_tests_refusal_h

#include <corotet/base/exceptions.h>

#include <functional>
#include <string>

namespace corotet::tests
{
  /// The text of the InputError that @p action throws: "ENTRY: MESSAGE", or
  /// "MESSAGE" if it blames no entry.
  inline std::string
  refusal(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        const std::string message = error.what();
        return error.entry.empty() ? message : error.entry + ": " + message;
      }
    return "nothing was refused";
  }
} // namespace corotet::tests

#endif
