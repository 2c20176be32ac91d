// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "selection.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace corotet::selections
{
  namespace
  {
    // The largest depth of parentheses and nots, more than anybody writes.
    constexpr unsigned int max_depth = 100;

    // Parses a selection from left to right; "not" binds closest, then "and".
    class Parser
    {
    public:
      Parser(const std::string &text,
             const Members     &members,
             const std::string &entry)
        : text(text)
        , members(members)
        , entry(entry)
      {
        std::string word;
        const auto  end_word = [&] {
          if (!word.empty())
            words.push_back(word);
          word.clear();
        };
        for (std::size_t i = 0; i < text.size(); ++i)
          if (const std::size_t end = end_of_quotes(text, i);
              end != std::string::npos)
            {
              word += text.substr(i, end + 1 - i);
              i = end;
            }
          else if (text[i] == '(' || text[i] == ')')
            {
              end_word();
              words.emplace_back(1, text[i]);
            }
          else if (text[i] == ' ' || text[i] == '\t' || text[i] == '\n')
            end_word();
          else
            word += text[i];
        end_word();
      }

      Selected
      parse()
      {
        Selected result;
        result.is_member = any_of();
        if (next < words.size())
          refuse("'and' or 'or' is expected");
        result.shapes = shapes;
        return result;
      }

    private:
      const std::string       &text;
      const Members           &members;
      const std::string       &entry;
      std::vector<std::string> words;
      std::size_t              next  = 0;
      unsigned int             depth = 0;
      std::vector<Shape>       shapes;

      bool
      is(const std::string &word) const
      {
        return next < words.size() && words[next] == word;
      }

      [[noreturn]] void
      refuse(const std::string &what) const
      {
        const std::string found = next < words.size() ?
                                    "'" + shortened(words[next], 40) + "'" :
                                    "the end";
        throw InputError(
          entry,
          fmt::format("{} in '{}': found {}", what, shortened(text), found));
      }

      std::vector<bool>
      any_of()
      {
        std::vector<bool> result = all_of();
        while (is("or"))
          {
            ++next;
            const std::vector<bool> other = all_of();
            for (std::size_t i = 0; i < result.size(); ++i)
              result[i] = result[i] || other[i];
          }
        return result;
      }

      std::vector<bool>
      all_of()
      {
        std::vector<bool> result = single();
        while (is("and"))
          {
            ++next;
            const std::vector<bool> other = single();
            for (std::size_t i = 0; i < result.size(); ++i)
              result[i] = result[i] && other[i];
          }
        return result;
      }

      std::vector<bool>
      single()
      {
        if (++depth > max_depth)
          throw InputError(entry,
                           fmt::format("a selection has more than {} "
                                       "parentheses or nots in each other",
                                       max_depth));
        std::vector<bool> result;
        if (is("not"))
          {
            ++next;
            result = single();
            result.flip();
          }
        else if (is("("))
          {
            ++next;
            result = any_of();
            if (!is(")"))
              refuse("')' is expected");
            ++next;
          }
        else
          result = shape();
        --depth;
        return result;
      }

      std::vector<bool>
      shape()
      {
        if (next == words.size() || is("and") || is("or") || is(")"))
          refuse("a shape or a name is expected");
        std::vector<std::string> own;
        while (next < words.size() && !is("and") && !is("or") && !is("(") &&
               !is(")"))
          own.push_back(words[next++]);
        if (!is_shape(own[0], members))
          return members.with_name(without_quotes(join(own, " ")));
        const Shape &measured =
          shapes.emplace_back(measure(own, members, entry));
        std::vector<bool> result(measured.distances.size());
        for (std::size_t i = 0; i < result.size(); ++i)
          result[i] = measured.distances[i] <= 0;
        return result;
      }
    };



    [[noreturn]] void
    refuse_nothing(const std::string &name,
                   const Selected    &selected,
                   const Members     &members,
                   const std::string &entry)
    {
      std::string reasons;
      for (const Shape &shape : selected.shapes)
        {
          double nearest = std::numeric_limits<double>::infinity();
          for (const double distance : shape.distances)
            nearest = std::min(nearest, distance);
          nearest = dealii::Utilities::MPI::min(nearest, members.communicator);
          reasons +=
            fmt::format("; the nearest to '{}' is {}",
                        shape.text,
                        nearest <= 0 ?
                          "inside" :
                          fmt::format("{:.4g} {} away", nearest, shape.unit));
        }
      throw InputError(
        entry,
        fmt::format("selection '{}' has no {}{}", name, members.kind, reasons));
    }
  } // namespace



  Selected
  select(const std::string &text,
         const Members     &members,
         const std::string &entry)
  {
    return Parser(text, members, entry).parse();
  }



  void
  select_by_names(
    const std::string                                           &text,
    const std::string                                           &entry,
    const Members                                               &members,
    const std::function<bool(const std::string &)>              &is_taken,
    const std::function<void(const std::string &,
                             const std::vector<std::size_t> &)> &give_name,
    Log                                                         &log)
  {
    for (const auto &[item, selection] :
         named_values(text, entry, "'name: selection, name: selection'"))
      {
        const std::string name = without_quotes(item);
        if (name.empty())
          throw InputError(entry,
                           fmt::format("a selection has no name: found '{}'; "
                                       "allowed: 'name: selection'",
                                       selection));
        if (is_taken(name))
          throw InputError(entry,
                           fmt::format("the mesh has this name, or another "
                                       "selection: found '{}'; give another "
                                       "one",
                                       name));
        const Selected           selected = select(selection, members, entry);
        std::vector<std::size_t> chosen;
        std::uint64_t            n_chosen = 0;
        for (std::size_t i = 0; i < selected.is_member.size(); ++i)
          if (selected.is_member[i])
            {
              chosen.push_back(i);
              n_chosen += members.is_counted[i] ? 1 : 0;
            }
        n_chosen = dealii::Utilities::MPI::sum(n_chosen, members.communicator);
        if (n_chosen == 0)
          refuse_nothing(name, selected, members, entry);
        give_name(name, chosen);
        std::string remarks;
        for (const Shape &shape : selected.shapes)
          if (!shape.remark.empty())
            remarks += fmt::format("; '{}' {}", shape.text, shape.remark);
        log.line(fmt::format(
          "  selection '{}': {} {}s{}", name, n_chosen, members.kind, remarks));
      }
  }
} // namespace corotet::selections
