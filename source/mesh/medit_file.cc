// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Files of Medit, as text.

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/base/whole_file.h>
#include <corotet/mesh/mesh_readers.h>

#include <fmt/format.h>

#include <cctype>
#include <climits>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <string_view>

#include "abaqus_lines.h"
#include "model_builder.h"

namespace corotet
{
  namespace
  {
    // The words of a file, without comments.
    class MeditWords
    {
    public:
      explicit MeditWords(const std::string &path)
        : path(path)
        , file(path)
      {
        if (!file)
          throw MachineError(path + ": cannot be read (permission?)");
        skip_byte_order_mark(file);
        find_next();
      }

      // The next word, which is not yet taken; empty at the end of the file.
      std::string_view
      peek() const
      {
        return std::string_view(line).substr(begin, end - begin);
      }

      std::string
      next()
      {
        const std::string result(peek());
        last_line = number;
        find_next();
        return result;
      }

      // Whether the next word is in another line than the last word taken.
      bool
      is_at_end_of_line() const
      {
        return number != last_line || begin == end;
      }

      bool
      is_at_keyword() const
      {
        return begin < end &&
               std::isalpha(static_cast<unsigned char>(line[begin])) != 0;
      }

      // The place of the last word taken.
      abaqus::Place
      place() const
      {
        return {path, last_line};
      }

      // Throws an InputError about the next word.
      [[noreturn]] void
      refuse_next(const std::string &expected) const
      {
        abaqus::Place{path, number}.refuse(
          expected + ": found " +
          (begin == end ? "the end of the file" :
                          "'" + shortened(std::string(peek()), 40) + "'"));
      }

    private:
      void
      find_next()
      {
        constexpr const char *blanks = " \t\r\v\f";
        begin                        = line.find_first_not_of(blanks, end);
        while (begin == std::string::npos)
          {
            if (!std::getline(file, line))
              {
                check_read_to_end(file, path);
                line.clear();
                begin = end = 0;
                return;
              }
            ++number;
            line.resize(std::min(line.find('#'), line.size()));
            begin = line.find_first_not_of(blanks);
          }
        end = std::min(line.find_first_of(blanks, begin), line.size());
      }

      const std::string path;
      std::ifstream     file;
      std::string       line;
      // The position of the next word in its line, and the number of this line.
      std::size_t begin = 0, end = 0;
      unsigned    number = 0, last_line = 0;
    };



    // gmsh's type of elements, and the nodes in gmsh's order.
    struct MeditType
    {
      int                      gmsh;
      std::vector<std::size_t> order;
    };



    class MeditReader
    {
    public:
      explicit MeditReader(const std::string &path)
        : words(path)
      {
        while (!words.peek().empty())
          {
            if (!words.is_at_keyword())
              refuse_excess();
            section = words.next();
            if (upper_case(section) == "END")
              break;
            read_section();
          }
      }

      GmshModel
      model() const
      {
        GmshModel result = builder.model();
        if (!left_out.empty())
          result.remark =
            "left out, as vertices, triangles and tetrahedra are read only: " +
            shortened(join({left_out.begin(), left_out.end()}), 300);
        return result;
      }

    private:
      // The type with this name. In Medit's files the nodes on the edges 1-2,
      // 2-3, 3-1, 1-4, 2-4, 3-4 follow the corners; gmsh has the last two in
      // opposite order.
      static std::optional<MeditType>
      type_of(const std::string &name)
      {
        if (name == "TRIANGLES")
          return MeditType{2, {0, 1, 2}};
        if (name == "TRIANGLESP2")
          return MeditType{9, {0, 1, 2, 3, 4, 5}};
        if (name == "TETRAHEDRA")
          return MeditType{4, {0, 1, 2, 3}};
        if (name == "TETRAHEDRAP2")
          return MeditType{11, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}};
        return {};
      }

      // Throws an InputError about entities beyond the number of their section.
      [[noreturn]] void
      refuse_excess() const
      {
        words.refuse_next(section.empty() ?
                            "the name of a section is expected" :
                            "the name of a section is expected behind all of " +
                              section +
                              (count ? fmt::format(", of which there "
                                                   "are {}",
                                                   *count) :
                                       ""));
      }

      void
      read_section()
      {
        const std::string name = upper_case(section);
        count.reset();
        if (name == "MESHVERSIONFORMATTED" || name == "DIMENSION")
          {
            const std::int64_t value = whole();
            if (name == "DIMENSION" && value != 3)
              words.place().refuse(
                fmt::format("the dimension: found {}; allowed is 3", value));
          }
        else if (name == "VERTICES")
          read_vertices();
        else if (const auto type = type_of(name))
          read_elements(*type);
        else
          skip(name);
      }

      std::int64_t
      whole()
      {
        const auto result = abaqus::whole_number(std::string(words.peek()));
        if (!result)
          words.refuse_next("a whole number is expected in " + section);
        words.next();
        return *result;
      }

      std::int64_t
      read_count()
      {
        count = whole();
        if (*count < 0)
          words.place().refuse(
            fmt::format("the number of {}: found {}; allowed are 0 and more",
                        section,
                        *count));
        return *count;
      }

      // Throws if the file ends although @p n_left entities of the section are
      // missing.
      void
      check_that_there_is_more(const std::int64_t n_left) const
      {
        if (words.is_at_keyword() || words.peek().empty())
          words.refuse_next(
            fmt::format("{} more {} are expected, as there are {}",
                        n_left,
                        section,
                        *count));
      }

      // Lines may have several entities, and entities several lines. But an
      // entity that begins behind another and does not end in its line has a
      // wrong number of numbers: gmsh writes ten nodes of tetrahedra where four
      // are expected.
      void
      check_line(const bool is_first, const std::size_t n_numbers) const
      {
        if (!is_first && words.is_at_end_of_line())
          words.place().refuse(
            fmt::format("a line of {} has {} numbers for each of them: found "
                        "a line that ends within one{}",
                        section,
                        n_numbers,
                        upper_case(section) == "VERTICES" ?
                          "" :
                          "; are these of another degree?"));
      }

      void
      read_vertices()
      {
        bool is_first = true;
        for (auto n = read_count(); n > 0; --n)
          {
            check_that_there_is_more(n);
            dealii::Point<3> x;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const std::string word = words.next();
                x[d]                   = abaqus::number(word, words.place());
                check_line(is_first, 4);
              }
            const std::string reference = words.next();
            abaqus::number(reference, words.place());
            is_first = words.is_at_end_of_line();
            if (!builder.add_node(++n_vertices, x))
              words.place().refuse("too many vertices");
          }
      }

      void
      read_elements(const MeditType &type)
      {
        std::vector<std::uint64_t> theirs(type.order.size()), nodes;
        bool                       is_first = true;
        for (auto n = read_count(); n > 0; --n)
          {
            check_that_there_is_more(n);
            for (std::uint64_t &node : theirs)
              {
                const std::int64_t number = whole();
                if (number < 1)
                  words.place().refuse(
                    fmt::format("a vertex in {}: found {}; allowed are 1 and "
                                "more",
                                section,
                                number));
                node = number;
                check_line(is_first, theirs.size() + 1);
              }
            const std::int64_t reference = whole();
            if (reference < 0 || reference > INT_MAX)
              words.place().refuse(
                fmt::format("a reference in {}: found {}; allowed are 0 and "
                            "more",
                            section,
                            reference));
            is_first = words.is_at_end_of_line();
            nodes.clear();
            for (const std::size_t i : type.order)
              nodes.push_back(theirs[i]);
            builder.add_to_group(builder.add_element(type.gmsh, nodes),
                                 static_cast<int>(reference));
          }
      }

      // Skips a section: numbers up to the name of the next section, except for
      // a few sections with a text in their line.
      void
      skip(const std::string &name)
      {
        const auto n = abaqus::whole_number(std::string(words.peek()));
        while (!n && !words.is_at_end_of_line())
          words.next();
        for (const std::string other :
             {"PRISMS", "PYRAMIDS", "HEXAHEDRA", "TETRAHEDRAP"})
          if (name.starts_with(other) && n != 0)
            {
              if (n)
                words.next();
              words.place().refuse(
                fmt::format("cells other than tetrahedra: found {} {}; allowed "
                            "are Tetrahedra",
                            n.value_or(1),
                            section));
            }
        if (n != 0)
          left_out.insert(section);
        while (!words.is_at_keyword() && !words.peek().empty())
          words.next();
      }

      MeditWords words;
      // The name of the present section, and its number of entities.
      std::string                 section;
      std::optional<std::int64_t> count;
      std::uint64_t               n_vertices = 0;
      std::set<std::string>       left_out;
      ModelBuilder                builder;
    };
  } // namespace



  GmshModel
  read_medit(const std::string &path)
  {
    return MeditReader(path).model();
  }
} // namespace corotet
