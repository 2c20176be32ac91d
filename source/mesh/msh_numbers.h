// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_msh_numbers_h
#define corotet_source_mesh_msh_numbers_h

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>

namespace corotet
{
  /// Reads the sections of a gmsh file of version 2, and their numbers, as text
  /// or as bytes. Functions throw InputError that names the file and, in text,
  /// the line.
  class MshNumbers
  {
  public:
    MshNumbers(const std::string &path, const std::string &origin)
      : origin(origin)
    {
      text = read_whole_file(path);
    }

    // Goes behind the line that begins the next section and returns its name,
    // without the dollar sign; empty at the end of the file.
    std::string
    next_section()
    {
      while (position < text.size())
        {
          const std::string line = rest_of_line();
          if (line.size() > 1 && line[0] == '$')
            return line.substr(1);
        }
      return "";
    }

    void
    skip_section(const std::string &name)
    {
      // The position may be behind the line end before "$End".
      const std::size_t end =
        text.find("\n$End" + name, position > 0 ? position - 1 : 0);
      position = end == std::string::npos ? text.size() : end + 1;
      rest_of_line();
    }

    // Checks that the end of a section follows, after all that its first line
    // has announced.
    void
    end_section(const std::string &name)
    {
      skip_blanks();
      const std::string end = "$End" + name;
      if (text.compare(position, end.size(), end) != 0)
        {
          const std::string found = shortened(
            text.substr(position, text.find('\n', position) - position), 40);
          refuse(
            fmt::format("{} is expected: found '{}'; does the section have "
                        "more than its first line says?",
                        end,
                        is_binary ? "bytes" : found));
        }
      rest_of_line();
    }

    // The rest of the line, without white space at its end.
    std::string
    rest_of_line()
    {
      begin_of_line          = position;
      const std::size_t end  = std::min(text.find('\n', position), text.size());
      std::string       line = text.substr(position, end - position);
      position               = std::min(end + 1, text.size());
      while (!line.empty() &&
             std::isspace(static_cast<unsigned char>(line.back())) != 0)
        line.pop_back();
      return line;
    }

    // Reads a number from text.
    template <typename Number>
    Number
    number()
    {
      skip_blanks();
      const char *begin = text.data() + position;
      const char *end   = text.data() + text.size();
      Number      result{};
      if (begin < end && *begin == '+')
        ++begin;
      const auto parsed = std::from_chars(begin, end, result);
      if (parsed.ec != std::errc() ||
          (parsed.ptr < end &&
           std::isspace(static_cast<unsigned char>(*parsed.ptr)) == 0))
        {
          const std::size_t stop =
            std::min(text.find_first_of(" \t\r\n", position), text.size());
          refuse(
            fmt::format("a number is expected: found '{}'",
                        shortened(text.substr(position, stop - position), 40)));
        }
      position = parsed.ptr - text.data();
      return result;
    }

    // Reads a number from bytes.
    template <typename Number>
    Number
    bytes()
    {
      Number result{};
      if (text.size() - position < sizeof(Number))
        throw InputError("",
                         origin + ": the file ends within its numbers: is "
                                  "the rest missing?");
      char raw[sizeof(Number)];
      std::copy_n(text.data() + position, sizeof(Number), raw);
      if (is_swapped)
        std::reverse(std::begin(raw), std::end(raw));
      std::memcpy(&result, raw, sizeof(Number));
      position += sizeof(Number);
      return result;
    }

    template <typename Number>
    Number
    next()
    {
      return is_binary ? bytes<Number>() : number<Number>();
    }

    [[noreturn]] void
    refuse(const std::string &message) const
    {
      if (is_binary)
        throw InputError("", origin + ": " + message);
      const auto line =
        1 + std::count(text.begin(), text.begin() + position, '\n');
      throw InputError("", fmt::format("{}:{}: {}", origin, line, message));
    }

    // Throws an InputError about the line that was read last.
    [[noreturn]] void
    refuse_line(const std::string &message)
    {
      position = begin_of_line;
      refuse(message);
    }

    void
    read_format()
    {
      const auto version = number<double>();
      const int  kind = number<int>(), size = number<int>();
      rest_of_line();
      if (version < 2 || version >= 3)
        refuse(fmt::format("found the version {}; allowed are 2 to 2.2, 4.0 "
                           "and 4.1",
                           version));
      if (kind != 0 && (kind != 1 || size != 8))
        refuse(fmt::format("found the kind {} with numbers of {} bytes; "
                           "allowed are 0 for text and 1 for binary with 8",
                           kind,
                           size));
      is_binary = kind == 1;
      if (!is_binary)
        return;
      const auto one = bytes<std::int32_t>();
      is_swapped     = one != 1;
      if (is_swapped && one != 0x01000000)
        refuse("the order of bytes is unknown; is the file damaged?");
    }

    void
    skip_blanks()
    {
      while (position < text.size() &&
             std::isspace(static_cast<unsigned char>(text[position])) != 0)
        ++position;
    }

    bool
    is_text() const
    {
      return !is_binary;
    }

  private:
    const std::string origin;
    std::string       text;
    std::size_t       position      = 0;
    std::size_t       begin_of_line = 0;
    bool              is_binary     = false;
    bool              is_swapped    = false;
  };
} // namespace corotet

#endif
