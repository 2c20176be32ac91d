// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_archive_h
#define corotet_base_archive_h

#include <corotet/base/exceptions.h>
#include <corotet/base/vector.h>

#include <array>
#include <charconv>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>
#include <vector>

namespace corotet
{
  /**
   * Transfers the state of a run to a checkpoint, or back from one.
   *
   * Every class with a state that outlives a step has one function transfer()
   * for both directions, so that what is written and what is read cannot
   * differ. Values have names, grouped in sections (within()). All members are
   * collective; when reading, they throw InputError if the checkpoint has no
   * such value.
   */
  class Archive
  {
  public:
    virtual ~Archive() = default;

    /// Whether values are read from a checkpoint. If not, they do not change.
    virtual bool
    is_reading() const = 0;

    /// Transfers a text that is the same on all ranks; that of rank 0 is
    /// written.
    virtual void
    transfer(const std::string &name, std::string &text) = 0;

    /// Transfers a vector of the body's unknowns, or an empty vector. A vector
    /// that is read has the same owned entries on any number of ranks, and no
    /// ghost entries.
    virtual void
    transfer(const std::string &name, Vector &vector) = 0;

    /// Transfers a number that is the same on all ranks, to the last bit.
    template <typename Number>
      requires std::is_arithmetic_v<Number>
    void
    transfer(const std::string &name, Number &number)
    {
      std::string text = written(number);
      transfer(name, text);
      if (!is_reading())
        return;
      const char *const end = text.data() + text.size();
      if (read(text.data(), end, number) != end)
        fail(name, text);
    }

    /// Transfers numbers that are the same on all ranks.
    template <typename Number>
    void
    transfer(const std::string &name, std::vector<Number> &numbers)
    {
      std::string text;
      for (const Number number : numbers)
        text += (text.empty() ? "" : " ") + written(number);
      transfer(name, text);
      if (!is_reading())
        return;
      numbers.clear();
      const char *const end = text.data() + text.size();
      for (const char *next = text.data(); next < end;)
        {
          const char *const behind = read(next, end, numbers.emplace_back());
          if (behind == nullptr || (behind != end && *behind != ' '))
            fail(name, text);
          next = behind == end ? end : behind + 1;
        }
    }

    /// Runs @p action; the names of all values that it transfers are in section
    /// @p name.
    template <typename Action>
    void
    within(const std::string &name, const Action &action)
    {
      const std::string outer = section;
      section += name + "/";
      action();
      section = outer;
    }

  protected:
    /// The prefix of names: the sections that are open.
    std::string section;

  private:
    /// The text of a number, with the fewest digits that give the same number.
    template <typename Number>
    static std::string
    written(const Number number)
    {
      if constexpr (std::is_same_v<Number, bool>)
        return number ? "true" : "false";
      else
        {
          std::array<char, 64> text;
          const auto           result =
            std::to_chars(text.data(), text.data() + text.size(), number);
          return {text.data(), result.ptr};
        }
    }

    /// Reads a number from [begin, end). Returns where it ends; null if there
    /// is none.
    template <typename Number>
    static const char *
    read(const char *begin, const char *end, Number &number)
    {
      if constexpr (std::is_same_v<Number, bool>)
        {
          const std::string_view text(begin, end - begin);
          number = text == "true";
          return number || text == "false" ? end : nullptr;
        }
      else
        {
          const auto result = std::from_chars(begin, end, number);
          return result.ec == std::errc() ? result.ptr : nullptr;
        }
    }

    [[noreturn]] void
    fail(const std::string &name, const std::string &text) const
    {
      throw InputError("",
                       "a checkpoint has '" + text + "' for '" + section +
                         name + "', which is no such number");
    }
  };
} // namespace corotet

#endif
