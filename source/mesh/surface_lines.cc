// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "surface_lines.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace corotet::surface_files
{
  namespace
  {
    constexpr std::string_view blanks = " \t\r\v\f";

    // The number that a whole word is.
    template <typename Number>
    bool
    parse(std::string_view word, Number &number)
    {
      // Which some programs write.
      if (word.size() > 1 && word[0] == '+')
        word.remove_prefix(1);
      const auto [end, error] =
        std::from_chars(word.data(), word.data() + word.size(), number);
      return error == std::errc() && end == word.data() + word.size();
    }
  } // namespace



  Lines::Lines(const std::string &path, const std::string &bytes)
    : path(path)
    , bytes(bytes)
  {}



  bool
  Lines::next(const char comment)
  {
    while (begin_of_next < bytes.size())
      {
        const std::size_t end =
          std::min(bytes.find('\n', begin_of_next), bytes.size());
        line =
          std::string_view(bytes).substr(begin_of_next, end - begin_of_next);
        begin_of_next = std::min(end + 1, bytes.size());
        ++line_number;
        if (comment != 0)
          line = line.substr(0, line.find(comment));
        present.clear();
        for (std::size_t i = 0; i < line.size();)
          {
            const std::size_t begin = line.find_first_not_of(blanks, i);
            if (begin == std::string_view::npos)
              break;
            i = std::min(line.find_first_of(blanks, begin), line.size());
            present.push_back(line.substr(begin, i - begin));
          }
        if (!present.empty())
          return true;
      }
    return false;
  }



  std::string
  Lines::rest() const
  {
    if (present.size() < 2)
      return "";
    const char *const begin = present[1].data();
    return {begin, present.back().data() + present.back().size()};
  }



  double
  Lines::number(const std::size_t i) const
  {
    double result = 0;
    if (i >= present.size())
      refuse(fmt::format("a number is missing after '{}'",
                         shortened(std::string(line), 40)));
    if (!parse(present[i], result) || !std::isfinite(result))
      refuse(fmt::format("a number is expected: found '{}'",
                         shortened(std::string(present[i]), 40)));
    return result;
  }



  long long
  Lines::integer(const std::size_t i) const
  {
    long long result = 0;
    if (i >= present.size())
      refuse("a whole number is missing at the end of the line");
    if (!parse(present[i], result))
      refuse(fmt::format("a whole number is expected: found '{}'",
                         shortened(std::string(present[i]), 40)));
    return result;
  }



  dealii::Point<3>
  Lines::point(const std::size_t i) const
  {
    return {number(i), number(i + 1), number(i + 2)};
  }



  void
  Lines::refuse(const std::string &message) const
  {
    throw InputError("", fmt::format("{}:{}: {}", path, line_number, message));
  }



  void
  Lines::refuse_end(const std::string &what) const
  {
    throw InputError(
      "",
      fmt::format("{}: the file ends before {}: is the rest missing?",
                  path,
                  what));
  }



  void
  add_polygon(TriangleSurface                 &surface,
              const std::vector<unsigned int> &corners,
              const unsigned int               group)
  {
    for (std::size_t i = 2; i < corners.size(); ++i)
      {
        surface.triangles.push_back({{corners[0], corners[i - 1], corners[i]}});
        surface.groups.push_back(group);
      }
  }



  void
  check_number_of_vertices(const TriangleSurface &surface)
  {
    // Those of STL are three for each triangle.
    constexpr std::size_t most = 2'000'000'000;
    if (surface.vertices.size() > most)
      throw InputError("",
                       fmt::format("{}: too many vertices: found more than {}",
                                   surface.origin,
                                   most));
  }
} // namespace corotet::surface_files
