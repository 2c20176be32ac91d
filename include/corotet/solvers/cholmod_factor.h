// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_cholmod_factor_h
#define corotet_solvers_cholmod_factor_h

#include <corotet/operators/ghost_exchange.h>

#include <cholmod.h>

#include <cstddef>
#include <vector>

namespace corotet
{
  /**
   * CHOLMOD's factor L of a symmetric positive definite matrix A with three
   * unknowns per node, or six per point, on one rank; see SparseCholesky.
   *
   * The user fills in the lower triangle of A row by row (for CHOLMOD, the
   * upper triangle column by column: it can permute that one in one pass),
   * calls analyze(), then as often as wanted writes values() and calls
   * factorize(). In single precision, values() are to be about one or less.
   */
  class CholmodFactor
  {
  public:
    /// Throws MachineError if memory is too short.
    CholmodFactor(const int         n_rows,
                  const std::size_t n_entries,
                  const bool        single_precision);

    ~CholmodFactor();

    CholmodFactor(const CholmodFactor &) = delete;
    CholmodFactor &
    operator=(const CholmodFactor &) = delete;

    /// The first entry of each row, and at the end the number of entries.
    int *
    row_starts()
    {
      return static_cast<int *>(lower->p);
    }

    const int *
    row_starts() const
    {
      return static_cast<const int *>(lower->p);
    }

    int *
    columns()
    {
      return static_cast<int *>(lower->i);
    }

    const int *
    columns() const
    {
      return static_cast<const int *>(lower->i);
    }

    /// The values in the order of columns(); float or double, as is_single()
    /// says.
    void *
    values()
    {
      return lower->x;
    }

    bool
    is_single() const
    {
      return lower->dtype == CHOLMOD_SINGLE;
    }

    /// Finds the order of elimination and the pattern of L. Throws MachineError
    /// if memory is too short, ComputationError if L is too large.
    void
    analyze();

    /// Continues in double precision; values() are lost.
    void
    convert_to_double();

    /// Computes L. Returns false if A is not positive definite up to round-off.
    /// The first call allocates the memory for solve().
    bool
    factorize();

    /// Number of entries of L, zeros in its supernodes included.
    std::size_t
    n_entries() const
    {
      return L->xsize;
    }

    /// Number of floating-point operations of factorize(), known after
    /// analyze().
    double
    n_operations() const
    {
      return operations;
    }

    /// dst = @p factor A^-1 src; both may be the same. Allocates no memory.
    template <typename Number>
    void
    solve(Number *dst, const Number *src, const double factor);

  private:
    int
    type() const
    {
      return CHOLMOD_REAL + lower->dtype;
    }

    void
    solve_rhs();
    bool
    find_points(const int size, NodeGraph &points) const;
    void
    order();
    void
    free_factor();
    template <typename Number>
    bool
    pivots_are_sound() const;
    void
    check_status() const;

    const int       n_rows;
    cholmod_common  common;
    cholmod_sparse *lower      = nullptr;
    cholmod_factor *L          = nullptr;
    cholmod_dense  *rhs        = nullptr;
    cholmod_dense  *solution   = nullptr;
    cholmod_dense  *work_y     = nullptr;
    cholmod_dense  *work_e     = nullptr;
    double          operations = 0;
    /// The unknowns in the order in which they are eliminated.
    std::vector<int> permutation;
  };
} // namespace corotet

#endif
