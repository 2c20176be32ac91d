// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_block_matrix_h
#define corotet_operators_block_matrix_h

#include <corotet/base/vector.h>
#include <corotet/operators/ghost_exchange.h>

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

namespace corotet
{
  /**
   * The pattern of a distributed square matrix of 3 x 3 blocks: node n has the
   * rows and columns 3n, 3n+1, 3n+2.
   *
   * Columns have local numbers, see NodeNumbers; the ghosts are nodes of other
   * ranks that are columns of owned rows.
   */
  class BlockPattern
  {
  public:
    /// @p rows are those of the owned nodes, with global column numbers; each
    /// must have its diagonal block. Collective.
    BlockPattern(const NodeGraph &rows, const MPI_Comm comm);

    MPI_Comm
    communicator() const
    {
      return comm;
    }

    /// The graph of the blocks; columns have local numbers.
    const NodeGraph &
    graph() const
    {
      return local_graph;
    }

    const NodeNumbers &
    nodes() const
    {
      return numbers;
    }

    int
    n_owned() const
    {
      return numbers.n_owned();
    }

    /// Exchanges values of owned nodes with the ranks where they are ghosts.
    const GhostExchange &
    exchange() const
    {
      return ghost_exchange;
    }

    /// The place of @p column among the columns of row @p node, which must have
    /// it.
    int
    place(const int node, const int column) const;

  private:
    MPI_Comm      comm;
    NodeNumbers   numbers;
    NodeGraph     local_graph;
    GhostExchange ghost_exchange;
  };

  /**
   * A distributed square matrix of 3 x 3 blocks in compressed rows: each of the
   * three rows of a node has its values one after the other, three of each
   * block, and all rows follow each other.
   */
  class BlockMatrix
  {
  public:
    /// Makes a matrix of zeros.
    explicit BlockMatrix(const std::shared_ptr<const BlockPattern> &pattern);

    /// Copies are forbidden, so that values do not have two owners by mistake.
    BlockMatrix(const BlockMatrix &) = delete;
    BlockMatrix &
    operator=(const BlockMatrix &) = delete;
    ~BlockMatrix()                 = default;

    /// The pattern; it is shared with all objects that depend on it and with
    /// other matrices of the same pattern.
    const std::shared_ptr<const BlockPattern> &
    pattern() const
    {
      return the_pattern;
    }

    /// Number of columns, and so of values, of each row of an owned node.
    int
    row_length(const int node) const
    {
      const auto &starts = the_pattern->graph().starts;
      return 3 * (starts[node + 1] - starts[node]);
    }

    /// The first value of row 3 @p node + @p component, a local number.
    double *
    row(const int node, const int component)
    {
      return values.data() + offset(node, component);
    }

    const double *
    row(const int node, const int component) const
    {
      return values.data() + offset(node, component);
    }

    std::array<const double *, 3>
    rows(const int node) const
    {
      return rows_of<3>(node);
    }

    /// The first values of the d rows of a point, which is d / 3 nodes.
    template <int d>
    std::array<const double *, d>
    rows_of(const int point) const
    {
      std::array<const double *, d> result;
      for (int a = 0; a < d; ++a)
        result[a] = row(d / 3 * point + a / 3, a % 3);
      return result;
    }

    template <int d>
    std::array<double *, d>
    rows_of(const int point)
    {
      std::array<double *, d> result;
      for (int a = 0; a < d; ++a)
        result[a] = row(d / 3 * point + a / 3, a % 3);
      return result;
    }

    /// The diagonal entry of an owned row, a local number.
    double &
    diagonal(const int row);
    double
    diagonal(const int row) const;

    /// The values of all rows of this rank.
    const double *
    values_begin() const
    {
      return values.data();
    }

    std::size_t
    n_values() const
    {
      return values.size();
    }

    /// The largest absolute value of this rank; 0 if it has none.
    double
    largest_value() const;

    void
    set_zero();

    /// Gives back the memory of the values until the next set_zero().
    void
    release_values()
    {
      std::vector<double>().swap(values);
    }

    void
    scale(const double factor);

    /// dst = A src, owned entries. Only the first call allocates memory.
    /// Collective.
    void
    vmult(double *dst, const double *src) const;

    void
    vmult(Vector &dst, const Vector &src) const;

  private:
    std::size_t
    offset(const int node, const int component) const
    {
      return 9 * static_cast<std::size_t>(the_pattern->graph().starts[node]) +
             static_cast<std::size_t>(component) * row_length(node);
    }

    std::shared_ptr<const BlockPattern> the_pattern;
    std::vector<double>                 values;
    /// The vector that is multiplied, with the entries of ghosts; unused
    /// without ghosts.
    mutable std::vector<double> source;
  };
} // namespace corotet

#endif
