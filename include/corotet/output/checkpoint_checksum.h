// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_checkpoint_checksum_h
#define corotet_output_checkpoint_checksum_h

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

/**
 * Checksums of checkpoints.
 */
namespace corotet::checkpoint_checksum
{
  /// Mixes the bits of x: every bit of the result depends on every bit of x
  /// (the finalizer of splitmix64; Steele, Lea, Flood, Fast splittable
  /// pseudorandom number generators, 2014).
  inline std::uint64_t
  mixed(std::uint64_t x)
  {
    x += 0x9e3779b97f4a7c15;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
    x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
    return x ^ (x >> 31);
  }

  /// The checksum of a word. Checksums are sums over words of eight bytes, each
  /// mixed with its place, so that different ranks may sum parts.
  inline std::uint64_t
  of_word(const std::uint64_t word, const std::uint64_t place)
  {
    return mixed(word ^ mixed(place));
  }

  /// The checksum of @p data, the bytes from word number @p first on.
  inline std::uint64_t
  of_bytes(const char *data, const std::size_t size, const std::uint64_t first)
  {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < size; i += 8)
      {
        std::uint64_t word = 0;
        std::memcpy(&word, data + i, std::min<std::size_t>(8, size - i));
        sum += of_word(word, first + i / 8);
      }
    return sum;
  }

  /// The text of a checksum, as JSON's numbers are not made for 64 bits.
  inline std::string
  in_words(const std::uint64_t checksum)
  {
    return fmt::format("{:016x}", checksum);
  }

  inline std::string
  of_text(const std::string &text)
  {
    return in_words(of_bytes(text.data(), text.size(), 0) + mixed(text.size()));
  }
} // namespace corotet::checkpoint_checksum

#endif
