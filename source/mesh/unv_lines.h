// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_source_mesh_unv_lines_h
#define corotet_source_mesh_unv_lines_h

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>

#include <fmt/format.h>

#include <climits>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "abaqus_lines.h"

namespace corotet
{
  /// A universal file, line by line. Functions throw InputError that names the
  /// file and the line.
  class UnvLines
  {
  public:
    using Words = std::vector<std::string>;

    explicit UnvLines(const std::string &path)
      : place{path, 0}
      , file(path)
    {
      if (!file)
        throw MachineError(path + ": cannot be read (permission?)");
      skip_byte_order_mark(file);
    }

    bool
    next()
    {
      ++place.line;
      const bool is_there = static_cast<bool>(std::getline(file, line));
      check_read_to_end(file, place.path);
      return is_there;
    }

    // Goes to the next line; throws if there is none.
    void
    need_next()
    {
      if (!next())
        place.refuse("the file ends within a dataset: is the rest missing?");
    }

    std::string
    trimmed() const
    {
      return abaqus::trimmed(line);
    }

    const std::string &
    text() const
    {
      return line;
    }

    Words
    words() const
    {
      std::istringstream stream(line);
      Words              result;
      for (std::string word; stream >> word;)
        result.push_back(word);
      return result;
    }

    Words
    needed_words()
    {
      need_next();
      return words();
    }

    // The next line of a dataset; nothing at the end of the dataset.
    std::optional<Words>
    record()
    {
      auto result = needed_words();
      if (result == Words{"-1"})
        return {};
      return result;
    }

    std::int64_t
    whole(const Words &of_line, const std::size_t i) const
    {
      const auto result =
        i < of_line.size() ? abaqus::whole_number(of_line[i]) : std::nullopt;
      if (!result)
        place.refuse(fmt::format(
          "a whole number is expected as word {} of the line: found '{}'",
          i + 1,
          i < of_line.size() ? shortened(of_line[i], 40) : ""));
      return *result;
    }

    std::uint64_t
    positive(const Words &of_line, const std::size_t i) const
    {
      const std::int64_t result = whole(of_line, i);
      if (result < 1 || result > INT_MAX)
        place.refuse(
          fmt::format("found {}; allowed is a positive whole number", result));
      return result;
    }

    abaqus::Place place;

  private:
    std::ifstream file;
    std::string   line;
  };
} // namespace corotet

#endif
