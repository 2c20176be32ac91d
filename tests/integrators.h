// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_integrators_h
#define corotet_tests_integrators_h

#include <corotet/time_integration/time_integrators.h>

#include <cctype>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace corotet::tests
{
  /// Names of the registered time integrators that have a property with their
  /// default parameters.
  inline std::vector<std::string>
  integrators_with(const std::function<bool(const TimeIntegrator &)> &property)
  {
    std::vector<std::string> names;
    for (const auto &candidate : time_integrators())
      if (property(*candidate.make()))
        names.push_back(candidate.name);
    return names;
  }

  /// The integrator of that name.
  inline std::unique_ptr<TimeIntegrator>
  make_integrator(const std::string &name)
  {
    for (const auto &candidate : time_integrators())
      if (candidate.name == name)
        return candidate.make();
    return nullptr;
  }

  inline bool
  is_dynamic(const TimeIntegrator &integrator)
  {
    return integrator.is_dynamic();
  }

  inline bool
  is_implicit_dynamic(const TimeIntegrator &integrator)
  {
    return integrator.is_dynamic() && !integrator.is_explicit();
  }

  /// A name for a parameterised test: letters and digits of its parameter.
  inline std::string
  letters_and_digits(std::string name)
  {
    std::erase_if(name, [](const unsigned char c) { return !std::isalnum(c); });
    return name;
  }
} // namespace corotet::tests

#endif
