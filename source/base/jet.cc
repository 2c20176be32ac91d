// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/jet.h>

namespace corotet
{
  Jet
  operator+(const Jet &a, const Jet &b)
  {
    return {a.value + b.value, a.first + b.first, a.second + b.second};
  }

  Jet
  operator-(const Jet &a, const Jet &b)
  {
    return {a.value - b.value, a.first - b.first, a.second - b.second};
  }

  Jet
  operator-(const Jet &a)
  {
    return {-a.value, -a.first, -a.second};
  }

  Jet
  operator*(const Jet &a, const Jet &b)
  {
    return {a.value * b.value,
            a.first * b.value + a.value * b.first,
            a.second * b.value + 2 * a.first * b.first + a.value * b.second};
  }

  Jet
  operator/(const Jet &a, const Jet &b)
  {
    const double q     = a.value / b.value;
    const double first = (a.first - q * b.first) / b.value;
    return {q,
            first,
            (a.second - 2 * first * b.first - q * b.second) / b.value};
  }

  Jet
  chain(const Jet &f, const Jet &a)
  {
    // A constant stays constant, whatever the derivatives of f are.
    if (a.is_constant())
      return {f.value};
    return {f.value,
            f.first * a.first,
            f.second * a.first * a.first + f.first * a.second};
  }

  double
  sign_soon(const Jet &a, const double soon)
  {
    const double later = a.value + soon * (a.first + 0.5 * soon * a.second);
    if (later != 0)
      return later;
    return a.first != 0 ? a.first : a.second;
  }
} // namespace corotet
