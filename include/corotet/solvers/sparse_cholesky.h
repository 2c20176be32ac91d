// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_sparse_cholesky_h
#define corotet_solvers_sparse_cholesky_h

#include <corotet/operators/block_matrix.h>

#include <deal.II/lac/la_parallel_vector.h>

#include <cstddef>
#include <memory>

namespace corotet
{
  /**
   * The inverse of a symmetric positive definite matrix A by a supernodal
   * factorisation P A P^T = L L^T (CHOLMOD; Chen, Davis, Hager, Rajamanickam
   * 2008) on rank 0, where the values are gathered.
   *
   * P comes from nested dissection (METIS) or minimum degree (AMD) of the graph
   * of nodes, which has a ninth of the matrix's entries. Only the lower
   * triangle of A is read.
   *
   * In single precision, factors take half the memory and half the time; the
   * relative error of a solution is about 1e-7 times the condition number, good
   * enough for a preconditioner. If they fail because of rounding, double
   * precision is used until the sparsity changes. A and the vectors may have
   * any size: they are scaled by powers of two, which is exact, before they
   * become single.
   */
  class SparseCholesky
  {
  public:
    enum class Precision
    {
      single_precision,
      double_precision
    };

    explicit SparseCholesky(
      const Precision precision = Precision::double_precision);

    ~SparseCholesky();

    /// Makes the first factors in double precision, as they were before a
    /// restart.
    void
    begin_in_double()
    {
      first = Precision::double_precision;
    }

    /// Finds only the ordering and the pattern of L, for n_entries() and
    /// n_operations(). Throws as factorize() does. Collective.
    void
    analyze(const BlockMatrix &A);

    /**
     * Computes L. Ordering and pattern are kept from the last call if @p A has
     * the same BlockPattern as then, which is kept alive for that.
     * Throws SingularMatrixError if A is not positive definite up to round-off,
     * ComputationError if L has too many entries (2^31), and MachineError if
     * memory is short; then there is no L. Collective.
     */
    void
    factorize(const BlockMatrix &A);

    /**
     * dst = A^-1 src, owned entries only; both may be the same. They are arrays
     * of float or double, distributed as the rows of A. Only the first call
     * allocates memory. Collective.
     */
    template <typename Number>
    void
    vmult(Number *dst, const Number *src) const;

    template <typename Number>
    void
    vmult(dealii::LinearAlgebra::distributed::Vector<Number>       &dst,
          const dealii::LinearAlgebra::distributed::Vector<Number> &src) const;

    /// Number of entries of L, with the zeros in its supernodes; the same on
    /// all ranks.
    std::size_t
    n_entries() const;

    /// Number of floating-point operations of a factorisation; the same on all
    /// ranks.
    double
    n_operations() const;

    /// Precision in which the present L is stored; the same on all ranks.
    Precision
    precision() const;

  private:
    struct Shares;
    class Factors;
    Precision                wanted;
    Precision                first = wanted;
    std::unique_ptr<Factors> factors;
  };
} // namespace corotet

#endif
