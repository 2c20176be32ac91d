// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/multi_vector.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace corotet
{
  namespace
  {
    // Number of entries of a column that are worked on before the next ones, so
    // that those of some columns fit into the first-level cache.
    constexpr unsigned int chunk = 512;

    // Number of columns of A that are read for each pass that writes the
    // result.
    constexpr unsigned int n_together = 4;

    // Calls f(begin, n) for all chunks of the owned entries.
    template <typename Function>
    void
    for_each_chunk(const unsigned int size, const Function &f)
    {
      for (unsigned int begin = 0; begin < size; begin += chunk)
        f(begin, std::min(chunk, size - begin));
    }

    // y += sum_k c_k x_k.
    template <unsigned int n_terms>
    void
    add_columns(double *y,
                const double *const (&x)[n_together],
                const double (&c)[n_together],
                const unsigned int n)
    {
      for (unsigned int i = 0; i < n; ++i)
        {
          double sum = y[i];
          for (unsigned int k = 0; k < n_terms; ++k)
            sum += c[k] * x[k][i];
          y[i] = sum;
        }
    }
  } // namespace

  VectorSpace::VectorSpace(const Vector                    &like,
                           const std::vector<unsigned int> &free)
    : zero(like.get_partitioner())
    , free(free)
    , dimension(
        dealii::Utilities::MPI::sum(free.size(), like.get_mpi_communicator()))
    , generator(1 + dealii::Utilities::MPI::this_mpi_process(
                      like.get_mpi_communicator()))
  {}

  MultiVector::MultiVector(const std::shared_ptr<VectorSpace> &space,
                           const unsigned int                  n)
    : the_space(space)
    , columns(n)
  {
    for (auto &column : columns)
      column = std::make_shared<Vector>(space->zero);
  }

  MultiVector
  MultiVector::view(const std::vector<int> &numbers) const
  {
    MultiVector result(the_space, 0);
    for (const int number : numbers)
      result.columns.push_back(columns[number]);
    return result;
  }

  MultiVector
  MultiVector::copy() const
  {
    MultiVector result(the_space, 0);
    for (const auto &column : columns)
      result.columns.push_back(std::make_shared<Vector>(*column));
    return result;
  }

  void
  MultiVector::assign(const MultiVector &other)
  {
    Assert(other.size() <= size(), dealii::ExcInternalError());
    for (unsigned int j = 0; j < other.size(); ++j)
      if (columns[j] != other.columns[j])
        *columns[j] = *other.columns[j];
  }

  void
  MultiVector::set_to_sum(const double       a,
                          const MultiVector &A,
                          const double       b,
                          const MultiVector &B)
  {
    // A vector whose factor is zero may have values that are not finite.
    if (a == 0 || b == 0)
      {
        const double factor = a == 0 ? b : a;
        if (factor == 0)
          {
            fill(0.);
            return;
          }
        assign(a == 0 ? B : A);
        for (auto &column : columns)
          *column *= factor;
        return;
      }
    for (unsigned int j = 0; j < size(); ++j)
      {
        const unsigned int n = columns[j]->locally_owned_size();
        double *const      y = columns[j]->begin();
        const double      *x = A[j].begin(), *z = B[j].begin();
        for (unsigned int i = 0; i < n; ++i)
          y[i] = a * x[i] + b * z[i];
      }
  }

  void
  MultiVector::add_product(const double                  a,
                           const MultiVector            &A,
                           const DenseView<const double> C,
                           const double                  b)
  {
    Assert(C.n_rows == A.size() && C.n_columns == size(),
           dealii::ExcInternalError());
    for_each_chunk(the_space->zero.locally_owned_size(),
                   [&](const unsigned int begin, const unsigned int n) {
                     for (unsigned int j = 0; j < size(); ++j)
                       {
                         double *const y = columns[j]->begin() + begin;
                         for (unsigned int i = 0; i < n; ++i)
                           y[i] = b == 0 ? 0. : b * y[i];
                         const double *x[n_together];
                         double        c[n_together];
                         unsigned int  k = 0;
                         for (; k + n_together <= A.size(); k += n_together)
                           {
                             for (unsigned int l = 0; l < n_together; ++l)
                               {
                                 x[l] = A[k + l].begin() + begin;
                                 c[l] = a * C(k + l, j);
                               }
                             add_columns<n_together>(y, x, c, n);
                           }
                         for (; k < A.size(); ++k)
                           {
                             x[0] = A[k].begin() + begin;
                             c[0] = a * C(k, j);
                             add_columns<1>(y, x, c, n);
                           }
                       }
                   });
  }

  void
  MultiVector::products(const DenseView<double> C,
                        const double            a,
                        const MultiVector      &A,
                        const MultiVector      &B)
  {
    Assert(C.n_rows == A.size() && C.n_columns == B.size(),
           dealii::ExcInternalError());
    std::vector<double> sums(static_cast<std::size_t>(A.size()) * B.size());
    for_each_chunk(A.the_space->zero.locally_owned_size(),
                   [&](const unsigned int begin, const unsigned int n) {
                     double *sum = sums.data();
                     for (unsigned int j = 0; j < B.size(); ++j)
                       for (unsigned int i = 0; i < A.size(); ++i)
                         *sum++ += inner_product({A[i].begin() + begin, n},
                                                 {B[j].begin() + begin, n});
                   });
    dealii::Utilities::MPI::sum(sums,
                                A.the_space->zero.get_mpi_communicator(),
                                sums);
    for (unsigned int j = 0; j < B.size(); ++j)
      for (unsigned int i = 0; i < A.size(); ++i)
        C(i, j) = a * sums[i + static_cast<std::size_t>(j) * A.size()];
  }

  std::vector<double>
  MultiVector::dots(const MultiVector &other) const
  {
    std::vector<double> result(size());
    for (unsigned int j = 0; j < size(); ++j)
      result[j] = local_inner_product(*columns[j], other[j]);
    dealii::Utilities::MPI::sum(result,
                                the_space->zero.get_mpi_communicator(),
                                result);
    return result;
  }

  void
  MultiVector::set_random()
  {
    std::uniform_real_distribution<double> random(-1, 1);
    for (auto &column : columns)
      for (const unsigned int i : the_space->free)
        column->local_element(i) = random(the_space->generator);
  }

  void
  MultiVector::fill(const double value)
  {
    for (auto &column : columns)
      for (const unsigned int i : the_space->free)
        column->local_element(i) = value;
  }
} // namespace corotet
