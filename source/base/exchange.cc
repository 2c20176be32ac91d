// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exchange.h>

#include <deal.II/base/mpi.h>

#include <cstdint>
#include <list>
#include <utility>

namespace corotet
{
  namespace
  {
    // The tags of the length of a message and of the message itself. No other
    // messages have these tags.
    constexpr int length_tag = 7301, message_tag = 7302;



    // Sends messages and meanwhile receives those of other ranks.
    class Exchange
    {
    public:
      explicit Exchange(const MPI_Comm comm)
        : comm(comm)
      {}

      void
      send(const unsigned int receiver, const std::vector<std::byte> &message)
      {
        const std::uint64_t &length = lengths.emplace_back(message.size());
        MPI_Issend(&length,
                   1,
                   MPI_UINT64_T,
                   receiver,
                   length_tag,
                   comm,
                   &started.emplace_back());
        const auto type =
          dealii::Utilities::MPI::create_mpi_data_type_n_bytes(length);
        MPI_Isend(message.data(),
                  1,
                  *type,
                  receiver,
                  message_tag,
                  comm,
                  &moving.emplace_back());
      }

      // Returns when all ranks have received all lengths, and this rank all its
      // messages.
      void
      receive(Messages &received)
      {
        MPI_Request barrier     = MPI_REQUEST_NULL;
        bool        is_sent     = false;
        int         all_are_got = 0;
        while (all_are_got == 0)
          {
            receive_one(received);
            if (is_sent)
              MPI_Test(&barrier, &all_are_got, MPI_STATUS_IGNORE);
            else
              {
                int done = 0;
                MPI_Testall(started.size(),
                            started.data(),
                            &done,
                            MPI_STATUSES_IGNORE);
                is_sent = done != 0;
                if (is_sent)
                  MPI_Ibarrier(comm, &barrier);
              }
          }
        MPI_Waitall(moving.size(), moving.data(), MPI_STATUSES_IGNORE);
        // No rank may begin the next exchange before all ranks have completed
        // this one.
        MPI_Barrier(comm);
      }

    private:
      void
      receive_one(Messages &received)
      {
        MPI_Status status;
        int        has_come = 0;
        MPI_Iprobe(MPI_ANY_SOURCE, length_tag, comm, &has_come, &status);
        if (has_come == 0)
          return;
        const int     sender = status.MPI_SOURCE;
        std::uint64_t length = 0;
        MPI_Recv(&length,
                 1,
                 MPI_UINT64_T,
                 sender,
                 length_tag,
                 comm,
                 MPI_STATUS_IGNORE);
        std::vector<std::byte> &message = received[sender];
        message.resize(length);
        const auto type =
          dealii::Utilities::MPI::create_mpi_data_type_n_bytes(length);
        MPI_Irecv(message.data(),
                  1,
                  *type,
                  sender,
                  message_tag,
                  comm,
                  &moving.emplace_back());
      }

      MPI_Comm comm;
      // The lengths that are being sent; a list, so that they keep their
      // addresses.
      std::list<std::uint64_t> lengths;
      std::vector<MPI_Request> started, moving;
    };
  } // namespace



  Messages
  exchange_messages(Messages &&sent, const MPI_Comm comm)
  {
    const unsigned int my_rank = dealii::Utilities::MPI::this_mpi_process(comm);
    Messages           received;
    if (auto own = sent.extract(my_rank); !own.empty())
      received.insert(std::move(own));
    if (dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
      return received;
    Exchange exchange(comm);
    for (const auto &[rank, message] : sent)
      exchange.send(rank, message);
    exchange.receive(received);
    return received;
  }
} // namespace corotet
