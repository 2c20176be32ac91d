// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A library to be loaded before a program's others (LD_PRELOAD): counts what
// this rank asks MPI for. At the end it writes "NAME CALLS BYTES" for each kind
// to the file of COROTET_TEST_MESSAGES, with the rank appended:
// messages     from this rank to another one
// reductions   of all ranks (sums, maxima, scans)
// gathers      to, or scatters from, one rank; broadcasts
// exchanges    of all ranks with all
// barriers
// Bytes are those that this rank sends: of gathers and exchanges its own part,
// of broadcasts and scatters what is sent to each. What a rank does with itself
// alone does not count.

#include <mpi.h>

#include <cstdlib>
#include <fstream>
#include <numeric>
#include <string>

namespace
{
  struct Kind
  {
    const char *name;
    long        calls = 0;
    long        bytes = 0;

    void
    add(const long count, const MPI_Datatype type)
    {
      int size = 0;
      PMPI_Type_size(type, &size);
      ++calls;
      bytes += count * size;
    }
  };

  Kind messages{"messages"}, reductions{"reductions"}, gathers{"gathers"},
    exchanges{"exchanges"}, barriers{"barriers"};

  long
  n_ranks(const MPI_Comm comm)
  {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    return size;
  }
} // namespace

// Defines the function MPI_NAME: it adds so many items to its kind, and calls
// the original function.
#define COUNTED(kind, count, type, name, parameters, arguments) \
  int MPI_##name parameters                                     \
  {                                                             \
    if (n_ranks(comm) > 1)                                      \
      (kind).add(count, type);                                  \
    return PMPI_##name arguments;                               \
  }

#define COUNTED_SEND(name)    \
  COUNTED(messages,           \
          n,                  \
          type,               \
          name,               \
          (const void  *data, \
           int          n,    \
           MPI_Datatype type, \
           int          to,   \
           int          tag,  \
           MPI_Comm     comm),    \
          (data, n, type, to, tag, comm))

#define COUNTED_ISEND(name)       \
  COUNTED(messages,               \
          n,                      \
          type,                   \
          name,                   \
          (const void  *data,     \
           int          n,        \
           MPI_Datatype type,     \
           int          to,       \
           int          tag,      \
           MPI_Comm     comm,     \
           MPI_Request *request), \
          (data, n, type, to, tag, comm, request))

#define COUNTED_REDUCTION(name) \
  COUNTED(reductions,           \
          n,                    \
          type,                 \
          name,                 \
          (const void  *data,   \
           void        *result, \
           int          n,      \
           MPI_Datatype type,   \
           MPI_Op       op,     \
           MPI_Comm     comm),      \
          (data, result, n, type, op, comm))

extern "C"
{
  COUNTED_SEND(Send)
  COUNTED_SEND(Ssend)
  COUNTED_SEND(Rsend)
  COUNTED_ISEND(Isend)
  COUNTED_ISEND(Issend)
  COUNTED_REDUCTION(Allreduce)
  COUNTED_REDUCTION(Scan)
  COUNTED_REDUCTION(Exscan)
  COUNTED(messages,
          n,
          type,
          Sendrecv,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           int          to,
           int          tag,
           void        *received,
           int          n_received,
           MPI_Datatype received_type,
           int          from,
           int          received_tag,
           MPI_Comm     comm,
           MPI_Status  *status),
          (data,
           n,
           type,
           to,
           tag,
           received,
           n_received,
           received_type,
           from,
           received_tag,
           comm,
           status))
  COUNTED(reductions,
          n,
          type,
          Reduce,
          (const void  *data,
           void        *result,
           int          n,
           MPI_Datatype type,
           MPI_Op       op,
           int          root,
           MPI_Comm     comm),
          (data, result, n, type, op, root, comm))
  COUNTED(reductions,
          n,
          type,
          Iallreduce,
          (const void  *data,
           void        *result,
           int          n,
           MPI_Datatype type,
           MPI_Op       op,
           MPI_Comm     comm,
           MPI_Request *request),
          (data, result, n, type, op, comm, request))
  COUNTED(gathers,
          n,
          type,
          Bcast,
          (void *data, int n, MPI_Datatype type, int root, MPI_Comm comm),
          (data, n, type, root, comm))
  COUNTED(gathers,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Gather,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           void        *all,
           int          n_all,
           MPI_Datatype all_type,
           int          root,
           MPI_Comm     comm),
          (data, n, type, all, n_all, all_type, root, comm))
  COUNTED(gathers,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Gatherv,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           void        *all,
           const int   *counts,
           const int   *offsets,
           MPI_Datatype all_type,
           int          root,
           MPI_Comm     comm),
          (data, n, type, all, counts, offsets, all_type, root, comm))
  COUNTED(gathers,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Scatter,
          (const void  *all,
           int          n_all,
           MPI_Datatype all_type,
           void        *data,
           int          n,
           MPI_Datatype type,
           int          root,
           MPI_Comm     comm),
          (all, n_all, all_type, data, n, type, root, comm))
  COUNTED(gathers,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Scatterv,
          (const void  *all,
           const int   *counts,
           const int   *offsets,
           MPI_Datatype all_type,
           void        *data,
           int          n,
           MPI_Datatype type,
           int          root,
           MPI_Comm     comm),
          (all, counts, offsets, all_type, data, n, type, root, comm))
  COUNTED(exchanges,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Allgather,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           void        *all,
           int          n_all,
           MPI_Datatype all_type,
           MPI_Comm     comm),
          (data, n, type, all, n_all, all_type, comm))
  COUNTED(exchanges,
          data == MPI_IN_PLACE ? 0 : n,
          type,
          Allgatherv,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           void        *all,
           const int   *counts,
           const int   *offsets,
           MPI_Datatype all_type,
           MPI_Comm     comm),
          (data, n, type, all, counts, offsets, all_type, comm))
  COUNTED(exchanges,
          n *n_ranks(comm),
          type,
          Alltoall,
          (const void  *data,
           int          n,
           MPI_Datatype type,
           void        *received,
           int          n_received,
           MPI_Datatype received_type,
           MPI_Comm     comm),
          (data, n, type, received, n_received, received_type, comm))
  COUNTED(exchanges,
          std::accumulate(counts, counts + n_ranks(comm), 0L),
          type,
          Alltoallv,
          (const void  *data,
           const int   *counts,
           const int   *offsets,
           MPI_Datatype type,
           void        *received,
           const int   *received_counts,
           const int   *received_offsets,
           MPI_Datatype received_type,
           MPI_Comm     comm),
          (data,
           counts,
           offsets,
           type,
           received,
           received_counts,
           received_offsets,
           received_type,
           comm))
  COUNTED(barriers, 0, MPI_BYTE, Barrier, (MPI_Comm comm), (comm))
  COUNTED(barriers,
          0,
          MPI_BYTE,
          Ibarrier,
          (MPI_Comm comm, MPI_Request *request),
          (comm, request))

  int
  MPI_Finalize()
  {
    const char *path = std::getenv("COROTET_TEST_MESSAGES");
    int         rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (path != nullptr)
      {
        std::ofstream file(path + std::to_string(rank));
        for (const Kind &kind :
             {messages, reductions, gathers, exchanges, barriers})
          file << kind.name << " " << kind.calls << " " << kind.bytes << "\n";
      }
    return PMPI_Finalize();
  }
}
