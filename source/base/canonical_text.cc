// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "canonical_text.h"

#include <corotet/base/text.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace corotet
{
  namespace
  {
    // The operation that a text is an operand of: a text of lower precedence
    // needs parentheses there.
    enum class Position
    {
      sum,
      product,
      divisor
    };

    std::string
    text_of(const GiNaC::ex &part, const Position position);

    std::string
    in_parentheses_if(const bool needs_them, const std::string &text)
    {
      return needs_them ? "(" + text + ")" : text;
    }

    bool
    is_division(const GiNaC::ex &part)
    {
      return GiNaC::is_a<GiNaC::power>(part) &&
             part.op(1).info(GiNaC::info_flags::negative);
    }

    GiNaC::ex
    divisor_of(const GiNaC::ex &division)
    {
      return GiNaC::pow(division.op(0), -division.op(1));
    }

    std::string
    sum_text(const GiNaC::ex &part)
    {
      std::vector<std::string> terms;
      for (std::size_t i = 0; i < part.nops(); ++i)
        terms.push_back(text_of(part.op(i), Position::sum));
      std::sort(terms.begin(), terms.end());
      return join(terms, "+");
    }

    std::string
    product_text(const GiNaC::ex &part)
    {
      std::vector<std::string> factors, divisors;
      for (std::size_t i = 0; i < part.nops(); ++i)
        if (is_division(part.op(i)))
          divisors.push_back(
            text_of(divisor_of(part.op(i)), Position::divisor));
        else
          factors.push_back(text_of(part.op(i), Position::product));
      if (factors.empty())
        factors.emplace_back("1.0");
      std::sort(factors.begin(), factors.end());
      std::sort(divisors.begin(), divisors.end());
      std::string text = join(factors, "*");
      for (const std::string &each : divisors)
        text += "/" + each;
      return text;
    }

    // x^n as products of squares.
    std::string
    repeated(const std::string &x, const int n)
    {
      if (n == 1)
        return x;
      if (n % 2 == 1)
        return x + "*" + repeated(x, n - 1);
      const std::string half = in_parentheses_if(n > 2, repeated(x, n / 2));
      return half + "*" + half;
    }

    std::string
    power_text(const GiNaC::ex &part, const Position position)
    {
      const GiNaC::ex &base = part.op(0), &exponent = part.op(1);
      if (is_division(part))
        return in_parentheses_if(position != Position::sum,
                                 "1.0/" + text_of(divisor_of(part),
                                                  Position::divisor));
      if (exponent.is_equal(GiNaC::numeric(1, 2)))
        return "sqrt(" + text_of(base, Position::sum) + ")";
      if (GiNaC::is_a<GiNaC::symbol>(base) &&
          exponent.info(GiNaC::info_flags::posint))
        return in_parentheses_if(
          position == Position::divisor,
          repeated(text_of(base, Position::product),
                   GiNaC::ex_to<GiNaC::numeric>(exponent).to_int()));
      return "pow(" + text_of(base, Position::sum) + "," +
             text_of(exponent, Position::sum) + ")";
    }

    std::string
    function_text(const GiNaC::ex &part)
    {
      std::vector<std::string> arguments;
      for (std::size_t i = 0; i < part.nops(); ++i)
        arguments.push_back(text_of(part.op(i), Position::sum));
      return GiNaC::ex_to<GiNaC::function>(part).get_name() + "(" +
             join(arguments, ",") + ")";
    }

    std::string
    text_of(const GiNaC::ex &part, const Position position)
    {
      if (GiNaC::is_a<GiNaC::add>(part))
        return in_parentheses_if(position != Position::sum, sum_text(part));
      if (GiNaC::is_a<GiNaC::mul>(part))
        return in_parentheses_if(position == Position::divisor,
                                 product_text(part));
      if (GiNaC::is_a<GiNaC::power>(part))
        return power_text(part, position);
      if (GiNaC::is_a<GiNaC::function>(part))
        return function_text(part);
      std::ostringstream text;
      text << GiNaC::csrc_double << part;
      // Negative numbers and fractions.
      return in_parentheses_if(GiNaC::is_a<GiNaC::numeric>(part) &&
                                 position != Position::sum,
                               text.str());
    }
  } // namespace

  std::string
  canonical_text(const GiNaC::ex &formula)
  {
    return text_of(formula, Position::sum);
  }
} // namespace corotet
