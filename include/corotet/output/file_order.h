// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_file_order_h
#define corotet_output_file_order_h

#include <corotet/base/hdf5_file.h>
#include <corotet/discretization/discretization.h>

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The order of cells or nodes in tables of files, which is the same on any
   * number of ranks. Each rank has a contiguous part of the rows of a table, in
   * general for other cells or nodes than those it owns.
   *
   * Cells are in the order of the mesh, nodes in the order in which cells use
   * them.
   *
   * All members but rows() are collective.
   */
  class FileOrder
  {
  public:
    static FileOrder
    of_cells(const Discretization &discretization);

    /// The order of @p nodes: those of @p discretization, or coarser ones on
    /// its cells.
    static FileOrder
    of_nodes(const Discretization &discretization, const Nodes &nodes);

    /// This rank's rows of a table with @p n_points rows for each cell or node
    /// and @p n_columns numbers in a row (0: a plain list).
    Hdf5Rows
    rows(const hsize_t n_columns = 0, const hsize_t n_points = 1) const
    {
      return {first * n_points,
              n_rows * n_points,
              n_global_rows * n_points,
              n_columns};
    }

    /// Writes a table with the @p values of owned cells or nodes.
    template <typename Number>
    void
    write(Hdf5File          &file,
          const std::string &name,
          const Number      *values,
          const hsize_t      n_columns = 0,
          const hsize_t      n_points  = 1) const
    {
      file.write(
        name,
        to_file(values, std::max<hsize_t>(1, n_columns) * n_points).data(),
        rows(n_columns, n_points));
    }

    /// This rank's rows of a table with the @p values of owned cells or nodes,
    /// @p n_columns numbers each.
    template <typename Number>
    std::vector<Number>
    to_file(const Number *values, const std::size_t n_columns = 1) const;

    /// The reverse of to_file(): @p values from this rank's @p rows.
    template <typename Number>
    void
    from_file(const Number     *rows,
              Number           *values,
              const std::size_t n_columns = 1) const;

    /// The row of each owned cell or node.
    std::vector<std::int64_t>
    row_numbers() const;

  private:
    /// @p keys are the keys of the cells or nodes that the rank owns, in [0,
    /// n_keys), different on all ranks together; rows are in the order of keys.
    FileOrder(const MPI_Comm                   comm,
              const std::vector<std::int64_t> &keys,
              const std::int64_t               n_keys);

    /// Sends @p n_columns numbers for each element of @p source, whose elements
    /// are in the order of the ranks that they are sent to.
    template <typename Number>
    std::vector<Number>
    exchange(std::vector<Number>     source,
             const std::vector<int> &n_to,
             const std::vector<int> &n_from,
             const std::size_t       n_columns) const;

    MPI_Comm comm;
    hsize_t  first         = 0;
    hsize_t  n_rows        = 0;
    hsize_t  n_global_rows = 0;
    /// Owned cells or nodes sorted by the ranks that have their rows, and how
    /// many belong to each rank.
    std::vector<unsigned int> by_rank;
    std::vector<int>          n_sent;
    /// The number of elements that each rank sends here, and the row of each
    /// element, counted from this rank's first row.
    std::vector<int>          n_received;
    std::vector<unsigned int> row_of_received;
  };
} // namespace corotet

#endif
