// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_multi_vector_h
#define corotet_solvers_multi_vector_h

#include <corotet/base/vector.h>

#include <cstddef>
#include <memory>
#include <random>
#include <vector>

namespace corotet
{
  /**
   * The space of the vectors of a MultiVector: all have one partitioning, and
   * only some of their unknowns may be other than zero.
   */
  struct VectorSpace
  {
    /// @p like is any of the vectors, @p free has the owned unknowns that may
    /// be other than zero. Collective.
    VectorSpace(const Vector &like, const std::vector<unsigned int> &free);

    const Vector                    zero;
    const std::vector<unsigned int> free;
    /// The number of free unknowns on all ranks.
    const std::size_t dimension;
    /// The random numbers differ from rank to rank.
    std::minstd_rand generator;
  };

  /**
   * A small dense matrix in memory that others own, by columns, which are
   * @p stride apart.
   */
  template <typename Number>
  struct DenseView
  {
    Number      *values;
    unsigned int n_rows, n_columns, stride;

    Number &
    operator()(const unsigned int i, const unsigned int j) const
    {
      return values[i + static_cast<std::size_t>(j) * stride];
    }
  };

  /**
   * Some vectors of one space side by side, as block methods for eigenvalues
   * use them: a matrix with few columns. Several objects may share columns;
   * these are views of each other.
   *
   * Products take one sum over the ranks for all of their numbers, and pass
   * through memory once for each few columns.
   */
  class MultiVector
  {
  public:
    /// @p n new columns, all zero.
    MultiVector(const std::shared_ptr<VectorSpace> &space,
                const unsigned int                  n);

    /// A view of the columns @p numbers.
    MultiVector
    view(const std::vector<int> &numbers) const;

    /// New columns with the same values.
    MultiVector
    copy() const;

    const std::shared_ptr<VectorSpace> &
    space() const
    {
      return the_space;
    }

    unsigned int
    size() const
    {
      return columns.size();
    }

    Vector &
    operator[](const unsigned int i)
    {
      return *columns[i];
    }

    const Vector &
    operator[](const unsigned int i) const
    {
      return *columns[i];
    }

    /// Sets the columns to those of @p other, which may have fewer.
    void
    assign(const MultiVector &other);

    /// this = a A + b B. A and B may be this.
    void
    set_to_sum(const double       a,
               const MultiVector &A,
               const double       b,
               const MultiVector &B);

    /// this = a A C + b this. A and this must have no column in common.
    void
    add_product(const double                  a,
                const MultiVector            &A,
                const DenseView<const double> C,
                const double                  b);

    /// C = a A^T B. Collective.
    static void
    products(const DenseView<double> C,
             const double            a,
             const MultiVector      &A,
             const MultiVector      &B);

    /// The product of each column with that of @p other. Collective.
    std::vector<double>
    dots(const MultiVector &other) const;

    /// Free unknowns get random values in [-1, 1].
    void
    set_random();

    /// Sets free unknowns to @p value.
    void
    fill(const double value);

  private:
    std::shared_ptr<VectorSpace>         the_space;
    std::vector<std::shared_ptr<Vector>> columns;
  };
} // namespace corotet

#endif
