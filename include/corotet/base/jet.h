// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_jet_h
#define corotet_base_jet_h

#include <map>
#include <string>

namespace corotet
{
  /**
   * The value, first and second derivative of a function of time at one
   * instant, as limits from later times. Operations on jets are the rules of
   * differentiation (forward automatic differentiation, Griewank and Walther,
   * Evaluating derivatives, 2008): exact but for round-off.
   */
  struct Jet
  {
    double value  = 0;
    double first  = 0;
    double second = 0;

    bool
    is_constant() const
    {
      return first == 0 && second == 0;
    }
  };

  Jet
  operator+(const Jet &a, const Jet &b);
  Jet
  operator-(const Jet &a, const Jet &b);
  Jet
  operator-(const Jet &a);
  Jet
  operator*(const Jet &a, const Jet &b);
  Jet
  operator/(const Jet &a, const Jet &b);

  /**
   * The jet of f(a), where @p f is the jet of f at a.value.
   */
  Jet
  chain(const Jet &f, const Jet &a);

  /**
   * The sign of @p a right after the instant: positive, negative, or 0 if the
   * function is zero there. That moment is later by @p soon, some units of
   * round-off, so that a time that misses a kink by round-off only is counted
   * as after it.
   */
  double
  sign_soon(const Jet &a, const double soon);

  /// A function of @p n arguments; @p soon as in sign_soon().
  using JetFunction = Jet (*)(const Jet         *arguments,
                              const unsigned int n,
                              const double       soon);

  /**
   * The functions and operators of formulas by name: "-" with two arguments,
   * "negate" with one, "?:" with three. Derivatives that do not exist are not
   * finite.
   */
  const std::map<std::string, JetFunction> &
  jet_functions();
} // namespace corotet

#endif
