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
// of broadcasts and scatters what is sent to each.

#include <mpi.h>

#include <cstdlib>
#include <fstream>
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
} // namespace

extern "C"
{
  int
  MPI_Send(const void  *data,
           int          n,
           MPI_Datatype type,
           int          to,
           int          tag,
           MPI_Comm     comm)
  {
    messages.add(n, type);
    return PMPI_Send(data, n, type, to, tag, comm);
  }

  int
  MPI_Ssend(const void  *data,
            int          n,
            MPI_Datatype type,
            int          to,
            int          tag,
            MPI_Comm     comm)
  {
    messages.add(n, type);
    return PMPI_Ssend(data, n, type, to, tag, comm);
  }

  int
  MPI_Isend(const void  *data,
            int          n,
            MPI_Datatype type,
            int          to,
            int          tag,
            MPI_Comm     comm,
            MPI_Request *request)
  {
    messages.add(n, type);
    return PMPI_Isend(data, n, type, to, tag, comm, request);
  }

  int
  MPI_Issend(const void  *data,
             int          n,
             MPI_Datatype type,
             int          to,
             int          tag,
             MPI_Comm     comm,
             MPI_Request *request)
  {
    messages.add(n, type);
    return PMPI_Issend(data, n, type, to, tag, comm, request);
  }

  int
  MPI_Rsend(const void  *data,
            int          n,
            MPI_Datatype type,
            int          to,
            int          tag,
            MPI_Comm     comm)
  {
    messages.add(n, type);
    return PMPI_Rsend(data, n, type, to, tag, comm);
  }

  int
  MPI_Sendrecv(const void  *data,
               int          n,
               MPI_Datatype type,
               int          to,
               int          tag,
               void        *received,
               int          n_received,
               MPI_Datatype type_received,
               int          from,
               int          tag_received,
               MPI_Comm     comm,
               MPI_Status  *status)
  {
    messages.add(n, type);
    return PMPI_Sendrecv(data,
                         n,
                         type,
                         to,
                         tag,
                         received,
                         n_received,
                         type_received,
                         from,
                         tag_received,
                         comm,
                         status);
  }

  int
  MPI_Allreduce(const void  *data,
                void        *result,
                int          n,
                MPI_Datatype type,
                MPI_Op       op,
                MPI_Comm     comm)
  {
    reductions.add(n, type);
    return PMPI_Allreduce(data, result, n, type, op, comm);
  }

  int
  MPI_Iallreduce(const void  *data,
                 void        *result,
                 int          n,
                 MPI_Datatype type,
                 MPI_Op       op,
                 MPI_Comm     comm,
                 MPI_Request *request)
  {
    reductions.add(n, type);
    return PMPI_Iallreduce(data, result, n, type, op, comm, request);
  }

  int
  MPI_Reduce(const void  *data,
             void        *result,
             int          n,
             MPI_Datatype type,
             MPI_Op       op,
             int          root,
             MPI_Comm     comm)
  {
    reductions.add(n, type);
    return PMPI_Reduce(data, result, n, type, op, root, comm);
  }

  int
  MPI_Scan(const void  *data,
           void        *result,
           int          n,
           MPI_Datatype type,
           MPI_Op       op,
           MPI_Comm     comm)
  {
    reductions.add(n, type);
    return PMPI_Scan(data, result, n, type, op, comm);
  }

  int
  MPI_Exscan(const void  *data,
             void        *result,
             int          n,
             MPI_Datatype type,
             MPI_Op       op,
             MPI_Comm     comm)
  {
    reductions.add(n, type);
    return PMPI_Exscan(data, result, n, type, op, comm);
  }

  int
  MPI_Bcast(void *data, int n, MPI_Datatype type, int root, MPI_Comm comm)
  {
    gathers.add(n, type);
    return PMPI_Bcast(data, n, type, root, comm);
  }

  int
  MPI_Gather(const void  *data,
             int          n,
             MPI_Datatype type,
             void        *all,
             int          n_all,
             MPI_Datatype type_all,
             int          root,
             MPI_Comm     comm)
  {
    gathers.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Gather(data, n, type, all, n_all, type_all, root, comm);
  }

  int
  MPI_Gatherv(const void  *data,
              int          n,
              MPI_Datatype type,
              void        *all,
              const int   *counts,
              const int   *offsets,
              MPI_Datatype type_all,
              int          root,
              MPI_Comm     comm)
  {
    gathers.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Gatherv(
      data, n, type, all, counts, offsets, type_all, root, comm);
  }

  int
  MPI_Scatter(const void  *all,
              int          n_all,
              MPI_Datatype type_all,
              void        *data,
              int          n,
              MPI_Datatype type,
              int          root,
              MPI_Comm     comm)
  {
    gathers.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Scatter(all, n_all, type_all, data, n, type, root, comm);
  }

  int
  MPI_Scatterv(const void  *all,
               const int   *counts,
               const int   *offsets,
               MPI_Datatype type_all,
               void        *data,
               int          n,
               MPI_Datatype type,
               int          root,
               MPI_Comm     comm)
  {
    gathers.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Scatterv(
      all, counts, offsets, type_all, data, n, type, root, comm);
  }

  int
  MPI_Allgather(const void  *data,
                int          n,
                MPI_Datatype type,
                void        *all,
                int          n_all,
                MPI_Datatype type_all,
                MPI_Comm     comm)
  {
    exchanges.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Allgather(data, n, type, all, n_all, type_all, comm);
  }

  int
  MPI_Allgatherv(const void  *data,
                 int          n,
                 MPI_Datatype type,
                 void        *all,
                 const int   *counts,
                 const int   *offsets,
                 MPI_Datatype type_all,
                 MPI_Comm     comm)
  {
    exchanges.add(data == MPI_IN_PLACE ? 0 : n, type);
    return PMPI_Allgatherv(data, n, type, all, counts, offsets, type_all, comm);
  }

  int
  MPI_Alltoall(const void  *data,
               int          n,
               MPI_Datatype type,
               void        *received,
               int          n_received,
               MPI_Datatype type_received,
               MPI_Comm     comm)
  {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    exchanges.add(static_cast<long>(n) * size, type);
    return PMPI_Alltoall(
      data, n, type, received, n_received, type_received, comm);
  }

  int
  MPI_Alltoallv(const void  *data,
                const int   *counts,
                const int   *offsets,
                MPI_Datatype type,
                void        *received,
                const int   *received_counts,
                const int   *received_offsets,
                MPI_Datatype received_type,
                MPI_Comm     comm)
  {
    int size = 0;
    PMPI_Comm_size(comm, &size);
    long n = 0;
    for (int rank = 0; rank < size; ++rank)
      n += counts[rank];
    exchanges.add(n, type);
    return PMPI_Alltoallv(data,
                          counts,
                          offsets,
                          type,
                          received,
                          received_counts,
                          received_offsets,
                          received_type,
                          comm);
  }

  int
  MPI_Barrier(MPI_Comm comm)
  {
    ++barriers.calls;
    return PMPI_Barrier(comm);
  }

  int
  MPI_Ibarrier(MPI_Comm comm, MPI_Request *request)
  {
    ++barriers.calls;
    return PMPI_Ibarrier(comm, request);
  }

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
