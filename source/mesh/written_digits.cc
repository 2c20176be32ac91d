// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "written_digits.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

namespace corotet
{
  namespace
  {
    // With fewer digits numbers are taken for round ones, which are exact; the
    // rounding errors of more digits are as small as other round-off.
    constexpr int least_digits = 5, most_digits = 12;

    bool
    is_of_floats(const dealii::Point<3> &x)
    {
      const auto is_float = [](const double value) {
        return value == static_cast<double>(static_cast<float>(value));
      };
      return is_float(x[0]) && is_float(x[1]) && is_float(x[2]);
    }
  } // namespace

  WrittenDigits::WrittenDigits(const std::vector<dealii::Point<3>> &nodes)
  {
    int most = 0;
    decimals = std::numeric_limits<int>::min();
    for (const dealii::Point<3> &x : nodes)
      for (unsigned int a = 0; a < 3; ++a)
        {
          if (x[a] == 0 || !std::isfinite(x[a]))
            continue;
          // The text of a number, "1.2345e-06".
          std::array<char, 32> text;
          const char *const    end = std::to_chars(text.begin(),
                                                text.end(),
                                                std::abs(x[a]),
                                                std::chars_format::scientific)
                                    .ptr;
          const std::string_view number(text.begin(), end);
          const std::size_t      e = number.find('e');
          const int n_digits       = e == 1 ? 1 : static_cast<int>(e) - 1;
          if (n_digits > most_digits)
            {
              is_single_precision = std::ranges::all_of(nodes, is_of_floats);
              if (is_single_precision)
                significant = std::numeric_limits<float>::digits10 + 1;
              return;
            }
          // from_chars() does not accept the plus sign of exponents.
          int         exponent = 0;
          const char *first    = text.begin() + e + 1;
          std::from_chars(first + (*first == '+' ? 1 : 0), end, exponent);
          most     = std::max(most, n_digits);
          decimals = std::max(decimals, n_digits - 1 - exponent);
        }
    if (most >= least_digits)
      significant = most;
  }

  double
  WrittenDigits::last_digit(const double size) const
  {
    if (significant == 0 || !(size > 0))
      return 0;
    if (is_single_precision)
      return std::numeric_limits<float>::epsilon() * size;
    const int exponent = static_cast<int>(std::floor(std::log10(size)));
    return std::pow(10., std::max(-decimals, exponent - significant + 1));
  }
} // namespace corotet
