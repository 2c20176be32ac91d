// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/utilities.h>

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <string_view>
#include <utility>

namespace corotet
{
  namespace
  {
    bool
    equal_letters(const char a, const char b)
    {
      return std::tolower(static_cast<unsigned char>(a)) ==
             std::tolower(static_cast<unsigned char>(b));
    }

    // Levenshtein distance, one row of the table at a time.
    std::size_t
    distance(const std::string &a, const std::string &b)
    {
      std::vector<std::size_t> row(b.size() + 1);
      std::iota(row.begin(), row.end(), std::size_t(0));
      for (std::size_t i = 0; i < a.size(); ++i)
        {
          std::size_t diagonal = row[0];
          row[0]               = i + 1;
          for (std::size_t j = 0; j < b.size(); ++j)
            {
              const std::size_t replaced =
                diagonal + (equal_letters(a[i], b[j]) ? 0 : 1);
              diagonal   = row[j + 1];
              row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
            }
        }
      return row.back();
    }
  } // namespace

  std::string
  nearest(const std::string &word, const std::vector<std::string> &candidates)
  {
    std::string best;
    std::size_t best_distance = std::numeric_limits<std::size_t>::max();
    for (const std::string &candidate : candidates)
      {
        const std::size_t shorter = std::min(word.size(), candidate.size());
        const std::size_t longer  = std::max(word.size(), candidate.size());
        const std::size_t near    = std::max<std::size_t>(1, longer / 3);
        // A text that is much longer or shorter is not compared.
        if (longer - shorter > near)
          continue;
        const std::size_t d = distance(word, candidate);
        if (d <= near && d < best_distance)
          {
            best          = candidate;
            best_distance = d;
          }
      }
    return best;
  }

  std::string
  join(const std::vector<std::string> &parts, const std::string &separator)
  {
    return fmt::format("{}", fmt::join(parts, separator));
  }

  namespace
  {
    // At most the first @p size bytes, without cutting a UTF-8 character.
    std::string
    start_of(const std::string &text, std::size_t size)
    {
      while (size > 0 &&
             (static_cast<unsigned char>(text[size]) & 0xc0) == 0x80)
        --size;
      return text.substr(0, size);
    }
  } // namespace

  std::optional<double>
  parse_number(std::string_view word)
  {
    if (word.size() > 1 && word[0] == '+' && word[1] != '-')
      word.remove_prefix(1);
    std::string with_e;
    if (const std::size_t d = word.find_first_of("dD");
        d != std::string_view::npos)
      {
        with_e    = word;
        with_e[d] = 'e';
        word      = with_e;
      }
    double     number        = 0;
    const auto end           = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, number);
    if (error != std::errc() || stop != end || !std::isfinite(number))
      return {};
    return number;
  }

  void
  skip_byte_order_mark(std::istream &file)
  {
    std::string start(byte_order_mark.size(), '\0');
    file.read(start.data(), start.size());
    file.clear();
    file.seekg(start == byte_order_mark ? byte_order_mark.size() : 0);
  }

  std::string
  shortened(const std::string &text, const std::size_t most)
  {
    if (text.size() <= most)
      return text;
    return fmt::format("{}... ({} characters)",
                       start_of(text, most),
                       text.size());
  }

  namespace
  {
    // Characters that are invisible, or look like a space or a hyphen: text
    // that is copied from web pages and documents may have them.
    constexpr std::array<std::pair<std::string_view, std::string_view>, 13>
      look_alikes{{{"\xc2\xa0", "U+00A0"},
                   {"\xc2\xad", "U+00AD"},
                   {"\xe2\x80\x87", "U+2007"},
                   {"\xe2\x80\x8b", "U+200B"},
                   {"\xe2\x80\x8c", "U+200C"},
                   {"\xe2\x80\x8d", "U+200D"},
                   {"\xe2\x80\x8e", "U+200E"},
                   {"\xe2\x80\x90", "U+2010"},
                   {"\xe2\x80\x91", "U+2011"},
                   {"\xe2\x80\xaf", "U+202F"},
                   {"\xe2\x81\xa0", "U+2060"},
                   {"\xe2\x88\x92", "U+2212"},
                   {"\xef\xbb\xbf", "U+FEFF"}}};
  } // namespace

  std::string
  printable(const std::string &message, const bool keep_lines)
  {
    constexpr std::size_t most = 4000;
    std::string           result;
    for (std::size_t i = 0; i < message.size(); ++i)
      {
        const auto byte = static_cast<unsigned char>(message[i]);
        const auto next = static_cast<unsigned char>(
          i + 1 < message.size() ? message[i + 1] : 0);
        const bool is_kept = keep_lines && (byte == '\n' || byte == '\t');
        const auto *const look_alike =
          byte < 0x80 ?
            look_alikes.end() :
            std::find_if(
              look_alikes.begin(),
              look_alikes.end(),
              [&](const auto &one) {
                return message.compare(i, one.first.size(), one.first) == 0;
              });
        if (look_alike != look_alikes.end())
          {
            result += fmt::format("<{}>", look_alike->second);
            i += look_alike->first.size() - 1;
            continue;
          }
        // Control characters above 0x7f, which also control terminals, have two
        // bytes in UTF-8.
        const bool is_high = byte == 0xc2 && next >= 0x80 && next < 0xa0;
        if (is_high || ((byte < 0x20 || byte == 0x7f) && !is_kept))
          result += fmt::format("\\x{:02x}", is_high ? next : byte);
        else
          result += message[i];
        if (is_high)
          ++i;
      }
    return result.size() <= most ? result : start_of(result, most) + "...";
  }

  std::vector<std::string>
  split_outside_brackets(const std::string &text, const char separator)
  {
    std::vector<std::string> parts(1);
    int                      depth = 0;
    for (std::size_t i = 0; i < text.size(); ++i)
      {
        const char c = text[i];
        if (const std::size_t end = end_of_quotes(text, i);
            end != std::string::npos)
          {
            parts.back() += text.substr(i, end + 1 - i);
            i = end;
            continue;
          }
        if (c == '(' || c == '[')
          ++depth;
        else if (c == ')' || c == ']')
          --depth;
        if (c == separator && depth <= 0)
          parts.emplace_back();
        else
          parts.back() += c;
      }
    for (std::string &part : parts)
      part = dealii::Utilities::trim(part);
    return parts;
  }



  std::string
  upper_case(const std::string_view text)
  {
    std::string result(text);
    for (char &c : result)
      c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return result;
  }
} // namespace corotet
