// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_exchange_h
#define corotet_base_exchange_h

#include <mpi.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <type_traits>
#include <vector>

namespace corotet
{
  /// Messages by the rank that they are sent to or received from.
  using Messages = std::map<unsigned int, std::vector<std::byte>>;

  /**
   * Gives each rank the messages that others have for it, of any length, also
   * above 2 GiB. No rank needs to know its senders, and only pairs of ranks
   * with a message communicate (the nonblocking consensus of Hoefler, Siebert
   * and Lumsdaine, 2010). A message of a rank to itself is moved. Collective.
   */
  Messages
  exchange_messages(Messages &&sent, const MPI_Comm comm);

  /// Appends an array of numbers, or of structures of numbers, to a message.
  template <typename T>
  void
  append_array(std::vector<std::byte> &message, const std::vector<T> &array)
  {
    static_assert(std::is_trivially_destructible_v<T>);
    const std::size_t n_bytes = sizeof(T) * array.size();
    const auto        append  = [&](const void *data, const std::size_t n) {
      const auto *bytes = static_cast<const std::byte *>(data);
      message.insert(message.end(), bytes, bytes + n);
    };
    append(&n_bytes, sizeof(n_bytes));
    if (n_bytes > 0)
      append(array.data(), n_bytes);
  }

  /// Reads an array that starts at @p position, and moves @p position behind
  /// it.
  template <typename T>
  void
  read_array(const std::vector<std::byte> &message,
             std::size_t                  &position,
             std::vector<T>               &array)
  {
    static_assert(std::is_trivially_destructible_v<T>);
    std::size_t n_bytes = 0;
    std::memcpy(&n_bytes, message.data() + position, sizeof(n_bytes));
    position += sizeof(n_bytes);
    array.resize(n_bytes / sizeof(T));
    if (n_bytes > 0)
      // dealii::Point has constructors, but is numbers and nothing else.
      std::memcpy(static_cast<void *>(array.data()),
                  message.data() + position,
                  n_bytes);
    position += n_bytes;
  }

  /// exchange_messages() for one array per pair of ranks, by the rank that it
  /// is sent to or received from.
  template <typename T>
  std::map<unsigned int, std::vector<T>>
  exchange_arrays(const std::map<unsigned int, std::vector<T>> &sent,
                  const MPI_Comm                                comm)
  {
    Messages messages;
    for (const auto &[rank, array] : sent)
      append_array(messages[rank], array);
    std::map<unsigned int, std::vector<T>> received;
    for (const auto &[rank, message] :
         exchange_messages(std::move(messages), comm))
      {
        std::size_t position = 0;
        read_array(message, position, received[rank]);
      }
    return received;
  }
} // namespace corotet

#endif
