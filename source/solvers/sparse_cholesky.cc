// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/mpi.h>
#include <corotet/solvers/cholmod_factor.h>
#include <corotet/solvers/linear_solver_errors.h>
#include <corotet/solvers/scaling.h>
#include <corotet/solvers/sparse_cholesky.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cstdint>
#include <exception>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace corotet
{
  using dealii::Utilities::MPI::mpi_type_id_for_type;

  /// The shares of all ranks in a distributed array; on rank 0 only.
  struct SparseCholesky::Shares
  {
    std::vector<int> counts, offsets;

    Shares() = default;

    /// Collective.
    Shares(const int own_count, const MPI_Comm comm)
      : counts(dealii::Utilities::MPI::gather(comm, own_count, 0))
      , offsets(counts.size())
    {
      std::exclusive_scan(counts.begin(), counts.end(), offsets.begin(), 0);
    }

    /// Puts the parts of all ranks into @p all on rank 0; there, the own part
    /// may be in place already. Collective.
    template <typename T>
    void
    gather(const T          *part,
           const std::size_t size,
           T                *all,
           const MPI_Comm    comm) const
    {
      const MPI_Datatype type        = mpi_type_id_for_type<T>;
      const bool         is_in_place = part == all && !counts.empty();
      // On a rank without nodes both pointers may be null.
      MPI_Gatherv(is_in_place ? MPI_IN_PLACE : part,
                  size,
                  type,
                  all,
                  counts.data(),
                  offsets.data(),
                  type,
                  0,
                  comm);
    }
  };

  /**
   * The data that depend on the graph of A, and the values.
   */
  class SparseCholesky::Factors
  {
  public:
    Factors(const std::shared_ptr<const BlockPattern> &pattern,
            const Precision                            precision);

    bool
    belong_to(const BlockMatrix &A) const
    {
      return A.pattern() == pattern;
    }

    void
    factorize(const BlockMatrix &A);

    template <typename Number>
    void
    solve(Number *dst, const Number *src);

    Precision   precision;
    std::size_t n_entries    = 0;
    double      n_operations = 0;

  private:
    void
    set_up(const std::vector<int> &columns);
    template <typename Number>
    void
    gather_values(const BlockMatrix &A);

    const std::shared_ptr<const BlockPattern> pattern;
    const MPI_Comm                            comm;
    const bool                                is_root;
    const bool                                is_alone;

    /// For each owned row the number of entries in its lower triangle, and
    /// their positions in the row, one row after another.
    std::vector<int> row_counts;
    std::vector<int> positions;
    Shares           row_shares;
    Shares           entry_shares;

    /// The divisor of A, with which single precision holds it.
    double unit = 1;

    /// The factor of A / unit, on rank 0 only.
    std::unique_ptr<CholmodFactor> factor;
    /// Own values on their way to rank 0; on rank 0, vectors of all ranks.
    std::tuple<std::vector<double>, std::vector<float>> buffers;
  };

  SparseCholesky::Factors::Factors(
    const std::shared_ptr<const BlockPattern> &pattern,
    const Precision                            precision)
    : precision(precision)
    , pattern(pattern)
    , comm(pattern->communicator())
    , is_root(dealii::Utilities::MPI::this_mpi_process(comm) == 0)
    , is_alone(dealii::Utilities::MPI::n_mpi_processes(comm) == 1)
  {
    const NodeGraph &graph = pattern->graph();
    // The entries of the lower triangle are counted before they are stored as
    // int.
    const std::int64_t n_unknowns =
      std::int64_t(3) * pattern->nodes().n_global();
    const double n_entries = dealii::Utilities::MPI::sum(
      9. * static_cast<double>(graph.columns.size()), comm);
    if ((n_entries + n_unknowns) / 2 > std::numeric_limits<int>::max())
      throw ComputationError("the matrix with " + std::to_string(n_unknowns) +
                             " unknowns is too large to be factorised: it has "
                             "more than 2^31 entries");
    std::vector<int> columns;
    for (int node = 0; node < pattern->n_owned(); ++node)
      for (int a = 0; a < 3; ++a)
        {
          const int         id     = 3 * pattern->nodes().global_node(node) + a;
          const std::size_t before = columns.size();
          const int         begin  = graph.starts[node];
          for (int k = begin; k < graph.starts[node + 1]; ++k)
            for (int b = 0; b < 3; ++b)
              {
                const int column =
                  3 * pattern->nodes().global_node(graph.columns[k]) + b;
                if (column <= id)
                  {
                    columns.push_back(column);
                    positions.push_back(3 * (k - begin) + b);
                  }
              }
          row_counts.push_back(columns.size() - before);
        }
    set_up(columns);
  }

  void
  SparseCholesky::Factors::set_up(const std::vector<int> &columns)
  {
    const int n_rows = 3 * pattern->nodes().n_global();
    row_shares       = Shares(row_counts.size(), comm);
    entry_shares     = Shares(columns.size(), comm);
    on_root(comm, [&] {
      const std::size_t total = std::accumulate(entry_shares.counts.begin(),
                                                entry_shares.counts.end(),
                                                std::size_t(0));
      factor                  = std::make_unique<CholmodFactor>(
        n_rows, total, precision == Precision::single_precision);
    });
    int *starts = is_root ? factor->row_starts() : nullptr;
    row_shares.gather(row_counts.data(),
                      row_counts.size(),
                      is_root ? starts + 1 : nullptr,
                      comm);
    entry_shares.gather(columns.data(),
                        columns.size(),
                        is_root ? factor->columns() : nullptr,
                        comm);
    on_root(comm, [&] {
      starts[0] = 0;
      std::partial_sum(starts, starts + n_rows + 1, starts);
      factor->analyze();
      n_entries    = factor->n_entries();
      n_operations = factor->n_operations();
      if (!is_alone)
        {
          std::get<std::vector<double>>(buffers).resize(n_rows);
          std::get<std::vector<float>>(buffers).resize(n_rows);
        }
    });
    n_entries    = dealii::Utilities::MPI::broadcast(comm, n_entries);
    n_operations = dealii::Utilities::MPI::broadcast(comm, n_operations);
  }

  template <typename Number>
  void
  SparseCholesky::Factors::gather_values(const BlockMatrix &A)
  {
    auto   &own  = std::get<std::vector<Number>>(buffers);
    Number *part = nullptr;
    if (is_root)
      part = static_cast<Number *>(factor->values());
    else
      {
        own.resize(positions.size());
        part = own.data();
      }
    const int   *position = positions.data();
    Number      *value    = part;
    const double inverse  = 1 / unit;
    for (unsigned int row = 0; row < row_counts.size(); ++row)
      {
        const double *values = A.row(row / 3, row % 3);
        for (int k = 0; k < row_counts[row]; ++k)
          *value++ = inverse * values[*position++];
      }
    if (!is_alone)
      entry_shares.gather(part,
                          positions.size(),
                          is_root ? part : nullptr,
                          comm);
  }

  void
  SparseCholesky::Factors::factorize(const BlockMatrix &A)
  {
    unit = unit_of(A);
    if (precision == Precision::single_precision)
      gather_values<float>(A);
    else
      gather_values<double>(A);
    bool succeeded = false;
    on_root(comm, [&] { succeeded = factor->factorize(); });
    succeeded = dealii::Utilities::MPI::broadcast(comm, succeeded);
    if (succeeded)
      return;
    if (precision == Precision::double_precision)
      throw SingularMatrixError(
        "the stiffness matrix is singular: the body or a part of it can move "
        "without resistance, because not enough is prescribed");
    precision = Precision::double_precision;
    on_root(comm, [&] { factor->convert_to_double(); });
    factorize(A);
  }

  template <typename Number>
  void
  SparseCholesky::Factors::solve(Number *dst, const Number *src)
  {
    if (is_alone)
      return factor->solve(dst, src, 1 / unit);
    auto &all = std::get<std::vector<Number>>(buffers);
    row_shares.gather(src, row_counts.size(), all.data(), comm);
    if (is_root)
      try
        {
          factor->solve(all.data(), all.data(), 1 / unit);
        }
      catch (const std::exception &)
        {
          // The solve has had its memory since the factorisation. If it fails
          // all the same, all ranks get values that are not numbers, without
          // another message.
          std::fill(all.begin(),
                    all.end(),
                    std::numeric_limits<Number>::quiet_NaN());
        }
    MPI_Scatterv(all.data(),
                 row_shares.counts.data(),
                 row_shares.offsets.data(),
                 mpi_type_id_for_type<Number>,
                 dst,
                 row_counts.size(),
                 mpi_type_id_for_type<Number>,
                 0,
                 comm);
  }

  SparseCholesky::SparseCholesky(const Precision precision)
    : wanted(precision)
  {}

  SparseCholesky::~SparseCholesky() = default;

  void
  SparseCholesky::analyze(const BlockMatrix &A)
  {
    if (!factors || !factors->belong_to(A))
      factors =
        std::make_unique<Factors>(A.pattern(), std::exchange(first, wanted));
  }

  void
  SparseCholesky::factorize(const BlockMatrix &A)
  {
    analyze(A);
    try
      {
        factors->factorize(A);
      }
    catch (...)
      {
        factors.reset();
        throw;
      }
  }

  template <typename Number>
  void
  SparseCholesky::vmult(Number *dst, const Number *src) const
  {
    Assert(factors, dealii::ExcNotInitialized());
    factors->solve(dst, src);
  }

  template <typename Number>
  void
  SparseCholesky::vmult(
    dealii::LinearAlgebra::distributed::Vector<Number>       &dst,
    const dealii::LinearAlgebra::distributed::Vector<Number> &src) const
  {
    vmult(dst.begin(), src.begin());
  }

  std::size_t
  SparseCholesky::n_entries() const
  {
    return factors ? factors->n_entries : 0;
  }

  double
  SparseCholesky::n_operations() const
  {
    return factors ? factors->n_operations : 0;
  }

  SparseCholesky::Precision
  SparseCholesky::precision() const
  {
    return factors ? factors->precision : first;
  }

  template void
  SparseCholesky::vmult(double *, const double *) const;
  template void
  SparseCholesky::vmult(float *, const float *) const;
  template void
  SparseCholesky::vmult(
    dealii::LinearAlgebra::distributed::Vector<double> &,
    const dealii::LinearAlgebra::distributed::Vector<double> &) const;
  template void
  SparseCholesky::vmult(
    dealii::LinearAlgebra::distributed::Vector<float> &,
    const dealii::LinearAlgebra::distributed::Vector<float> &) const;
} // namespace corotet
