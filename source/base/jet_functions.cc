// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// The rules of differentiation of all functions and operators of formulas.

#include <corotet/base/jet.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace corotet
{
  namespace
  {
    const double not_a_number = std::numeric_limits<double>::quiet_NaN();

    Jet
    logarithm(const Jet &a)
    {
      const double inverse = 1 / a.value;
      return chain({std::log(a.value), inverse, -inverse * inverse}, a);
    }

    Jet
    exponential(const Jet &a)
    {
      const double e = std::exp(a.value);
      return chain({e, e, e}, a);
    }

    Jet
    power(const Jet &a, const Jet &b)
    {
      const double value = std::pow(a.value, b.value);
      if (!b.is_constant())
        return chain({value, value, value}, b * logarithm(a));
      // The derivatives of x^0 and x^1 that vanish are set to 0: the formula
      // could give zero times infinity.
      const double n = b.value;
      return chain({value,
                    n == 0 ? 0 : n * std::pow(a.value, n - 1),
                    n == 0 || n == 1 ? 0 :
                                       n * (n - 1) * std::pow(a.value, n - 2)},
                   a);
    }

    Jet
    square_root(const Jet &a)
    {
      const double s = std::sqrt(a.value);
      return chain({s, 0.5 / s, -0.25 / (s * a.value)}, a);
    }

    Jet
    sine(const Jet &a)
    {
      const double s = std::sin(a.value);
      return chain({s, std::cos(a.value), -s}, a);
    }

    Jet
    cosine(const Jet &a)
    {
      const double c = std::cos(a.value);
      return chain({c, -std::sin(a.value), -c}, a);
    }

    Jet
    tangent(const Jet &a)
    {
      const double value = std::tan(a.value);
      const double first = 1 + value * value;
      return chain({value, first, 2 * value * first}, a);
    }

    // A function with the first derivative (c + s a^2)^(-1/2).
    Jet
    inverse_root(const double value,
                 const double c,
                 const double s,
                 const Jet   &a)
    {
      const double first = 1 / std::sqrt(c + s * a.value * a.value);
      return chain({value, first, -s * a.value * first * first * first}, a);
    }

    // A function with the first derivative 1 / (1 + s a^2).
    Jet
    inverse_square(const double value, const double s, const Jet &a)
    {
      const double first = 1 / (1 + s * a.value * a.value);
      return chain({value, first, -2 * s * a.value * first * first}, a);
    }

    Jet
    arc_tangent(const Jet &y, const Jet &x)
    {
      const double square = x.value * x.value + y.value * y.value;
      const double first  = (x.value * y.first - y.value * x.first) / square;
      const double second =
        (x.value * y.second - y.value * x.second -
         2 * first * (x.value * x.first + y.value * y.first)) /
        square;
      const double value = std::atan2(y.value, x.value);
      return x.is_constant() && y.is_constant() ? Jet{value} :
                                                  Jet{value, first, second};
    }

    Jet
    error_function(const double value, const double sign, const Jet &a)
    {
      const double first = sign * 2 / std::sqrt(dealii::numbers::PI) *
                           std::exp(-a.value * a.value);
      return chain({value, first, -2 * a.value * first}, a);
    }

    Jet
    floor(const Jet &a, const double soon)
    {
      if (!std::isfinite(a.value))
        return {not_a_number};
      const double nearest = std::round(a.value);
      return {sign_soon(a - Jet{nearest}, soon) < 0 ? nearest - 1 : nearest};
    }

    Jet
    signum(const Jet &a, const double soon)
    {
      const double s = sign_soon(a, soon);
      if (s < 0)
        return {-1.};
      return {s > 0 ? 1. : 0.};
    }

    Jet
    absolute_value(const Jet &a, const double soon)
    {
      return sign_soon(a, soon) < 0 ? -a : a;
    }

    Jet
    truth(const bool is_true)
    {
      return {is_true ? 1. : 0.};
    }

    // Whether a condition of if(), | or & is true: they round it.
    bool
    rounds_to_true(const Jet &a, const double soon)
    {
      return sign_soon(absolute_value(a, soon) - Jet{0.5}, soon) >= 0;
    }

    // The jet of ramp(t, t0, t1) with the arguments @p a.
    Jet
    ramp_rule(const Jet *a, const double soon)
    {
      if (!(a[1].value <= a[2].value))
        return {not_a_number};
      if (sign_soon(a[0] - a[1], soon) < 0)
        return {0};
      if (sign_soon(a[0] - a[2], soon) >= 0)
        return {1};
      return (a[0] - a[1]) / (a[2] - a[1]);
    }

    // Wrappers that make a JetFunction of a function of one jet (unary), of two
    // jets (binary), or of one jet and soon (timed).
    template <auto f>
    Jet
    unary(const Jet *a, const unsigned int, const double)
    {
      return f(a[0]);
    }

    template <auto f>
    Jet
    binary(const Jet *a, const unsigned int, const double)
    {
      return f(a[0], a[1]);
    }

    template <auto f>
    Jet
    timed(const Jet *a, const unsigned int, const double soon)
    {
      return f(a, soon);
    }

    // The truth value of a comparison: is_true() gets sign_soon() of the
    // difference of the two arguments, and 0.
    template <auto is_true>
    Jet
    comparison(const Jet *a, const unsigned int, const double soon)
    {
      return truth(is_true(sign_soon(a[0] - a[1], soon), 0.));
    }

    // The least (sign = 1) or largest (sign = -1) of the arguments.
    template <int sign>
    Jet
    extreme(const Jet *a, const unsigned int n, const double soon)
    {
      Jet result = a[0];
      for (unsigned int i = 1; i < n; ++i)
        if (sign * sign_soon(a[i] - result, soon) < 0)
          result = a[i];
      return result;
    }

    Jet
    sum(const Jet *a, const unsigned int n, const double)
    {
      Jet result = a[0];
      for (unsigned int i = 1; i < n; ++i)
        result = result + a[i];
      return result;
    }

    Jet
    mean(const Jet *a, const unsigned int n, const double soon)
    {
      return sum(a, n, soon) / Jet{static_cast<double>(n)};
    }

    std::map<std::string, JetFunction>
    operators()
    {
      return {{"+", binary<[](const Jet &a, const Jet &b) { return a + b; }>},
              {"-", binary<[](const Jet &a, const Jet &b) { return a - b; }>},
              {"*", binary<[](const Jet &a, const Jet &b) { return a * b; }>},
              {"/", binary<[](const Jet &a, const Jet &b) { return a / b; }>},
              {"^", binary<power>},
              {"negate", unary<[](const Jet &a) { return -a; }>},
              {"<", comparison<std::less<double>{}>},
              {">", comparison<std::greater<double>{}>},
              {"<=", comparison<std::less_equal<double>{}>},
              {">=", comparison<std::greater_equal<double>{}>},
              {"==", comparison<std::equal_to<double>{}>},
              {"!=", comparison<std::not_equal_to<double>{}>},
              {"&&", timed<[](const Jet *a, const double soon) {
                 return truth(sign_soon(a[0], soon) != 0 &&
                              sign_soon(a[1], soon) != 0);
               }>},
              {"||", timed<[](const Jet *a, const double soon) {
                 return truth(sign_soon(a[0], soon) != 0 ||
                              sign_soon(a[1], soon) != 0);
               }>},
              {"&", timed<[](const Jet *a, const double soon) {
                 return truth(rounds_to_true(a[0], soon) &&
                              rounds_to_true(a[1], soon));
               }>},
              {"|", timed<[](const Jet *a, const double soon) {
                 return truth(rounds_to_true(a[0], soon) ||
                              rounds_to_true(a[1], soon));
               }>},
              {"?:", timed<[](const Jet *a, const double soon) {
                 return sign_soon(a[0], soon) != 0 ? a[1] : a[2];
               }>}};
    }

    std::map<std::string, JetFunction>
    smooth_functions()
    {
      return {{"sin", unary<sine>},
              {"cos", unary<cosine>},
              {"tan", unary<tangent>},
              {"cot", unary<[](const Jet &a) { return Jet{1} / tangent(a); }>},
              {"csc", unary<[](const Jet &a) { return Jet{1} / sine(a); }>},
              {"sec", unary<[](const Jet &a) { return Jet{1} / cosine(a); }>},
              {"asin", unary<[](const Jet &a) {
                 return inverse_root(std::asin(a.value), 1, -1, a);
               }>},
              {"acos", unary<[](const Jet &a) {
                 return -inverse_root(-std::acos(a.value), 1, -1, a);
               }>},
              {"atan", unary<[](const Jet &a) {
                 return inverse_square(std::atan(a.value), 1, a);
               }>},
              {"atan2", binary<arc_tangent>},
              {"sinh", unary<[](const Jet &a) {
                 const double s = std::sinh(a.value);
                 return chain({s, std::cosh(a.value), s}, a);
               }>},
              {"cosh", unary<[](const Jet &a) {
                 const double c = std::cosh(a.value);
                 return chain({c, std::sinh(a.value), c}, a);
               }>},
              {"tanh", unary<[](const Jet &a) {
                 const double value = std::tanh(a.value);
                 const double first =
                   1 / (std::cosh(a.value) * std::cosh(a.value));
                 return chain({value, first, -2 * value * first}, a);
               }>},
              {"asinh", unary<[](const Jet &a) {
                 return inverse_root(std::asinh(a.value), 1, 1, a);
               }>},
              {"acosh", unary<[](const Jet &a) {
                 return inverse_root(std::acosh(a.value), -1, 1, a);
               }>},
              {"atanh", unary<[](const Jet &a) {
                 return inverse_square(std::atanh(a.value), -1, a);
               }>},
              {"ln", unary<logarithm>},
              {"log", unary<logarithm>},
              {"log2", unary<[](const Jet &a) {
                 return logarithm(a) / Jet{std::numbers::ln2};
               }>},
              {"log10", unary<[](const Jet &a) {
                 return logarithm(a) / Jet{std::numbers::ln10};
               }>},
              {"exp", unary<exponential>},
              {"sqrt", unary<square_root>},
              {"pow", binary<power>},
              {"erf", unary<[](const Jet &a) {
                 return error_function(std::erf(a.value), 1, a);
               }>},
              {"erfc", unary<[](const Jet &a) {
                 return error_function(std::erfc(a.value), -1, a);
               }>},
              {"sum", sum},
              {"avg", mean}};
    }

    std::map<std::string, JetFunction>
    piecewise_functions()
    {
      return {{"abs", timed<[](const Jet *a, const double soon) {
                 return absolute_value(a[0], soon);
               }>},
              {"sign", timed<[](const Jet *a, const double soon) {
                 return signum(a[0], soon);
               }>},
              {"floor", timed<[](const Jet *a, const double soon) {
                 return floor(a[0], soon);
               }>},
              {"ceil", timed<[](const Jet *a, const double soon) {
                 return -floor(-a[0], soon);
               }>},
              {"int", timed<[](const Jet *a, const double soon) {
                 return floor(a[0] + Jet{0.5}, soon);
               }>},
              {"rint", timed<[](const Jet *a, const double soon) {
                 return floor(a[0] + Jet{0.5}, soon);
               }>},
              {"min", extreme<1>},
              {"max", extreme<-1>},
              {"if", timed<[](const Jet *a, const double soon) {
                 return rounds_to_true(a[0], soon) ? a[1] : a[2];
               }>},
              {"ramp", timed<ramp_rule>},
              {"smooth_step", timed<[](const Jet *a, const double soon) {
                 const Jet s = ramp_rule(a, soon);
                 return s * s * s * (Jet{10} + s * (Jet{6} * s - Jet{15}));
               }>},
              {"pulse", timed<[](const Jet *a, const double soon) {
                 if (std::isnan(ramp_rule(a, soon).value))
                   return Jet{not_a_number};
                 return truth(sign_soon(a[0] - a[1], soon) >= 0 &&
                              sign_soon(a[0] - a[2], soon) < 0);
               }>},
              {"half_sine", timed<[](const Jet *a, const double soon) {
                 return sine(Jet{dealii::numbers::PI} * ramp_rule(a, soon));
               }>},
              {"triangle", timed<[](const Jet *a, const double soon) {
                 return Jet{1} -
                        absolute_value(Jet{2} * ramp_rule(a, soon) - Jet{1},
                                       soon);
               }>}};
    }
  } // namespace

  const std::map<std::string, JetFunction> &
  jet_functions()
  {
    static const std::map<std::string, JetFunction> functions = [] {
      std::map<std::string, JetFunction> result = operators();
      result.merge(smooth_functions());
      result.merge(piecewise_functions());
      return result;
    }();
    return functions;
  }
} // namespace corotet
