// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_vector_h
#define corotet_base_vector_h

#include <deal.II/lac/la_parallel_vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace corotet
{
  /**
   * A distributed vector of unknowns: three per node (x, y, z), contiguous.
   * Owned entries come first, then ghosts.
   */
  using Vector = dealii::LinearAlgebra::distributed::Vector<double>;

  /// Inner product of two arrays of the same length.
  double
  inner_product(const std::span<const double> a,
                const std::span<const double> b);

  /// The square of the length of the vector at owned node @p n.
  inline double
  square_at_node(const Vector &v, const unsigned int n)
  {
    double square = 0;
    for (unsigned int a = 0; a < 3; ++a)
      square += v.local_element(3 * n + a) * v.local_element(3 * n + a);
    return square;
  }

  /// This rank's share of the inner product of two vectors.
  inline double
  local_inner_product(const Vector &a, const Vector &b)
  {
    return inner_product({a.begin(), a.locally_owned_size()},
                         {b.begin(), b.locally_owned_size()});
  }

  /// Replaces each rank's shares of several sums by the sums over all ranks,
  /// with one message. Collective.
  void
  sum_over_ranks(const std::span<double> values, const MPI_Comm comm);

  /// This rank's shares of the inner products of several pairs of vectors, all
  /// of the same layout. Vectors that are in more than one pair are read once.
  template <std::size_t n>
  std::array<double, n>
  local_inner_products(
    const std::array<std::pair<const Vector *, const Vector *>, n> &pairs)
  {
    // The size of blocks of entries, such that the blocks of all vectors stay
    // in the first-level cache.
    constexpr std::size_t block_size = 1024;
    const std::size_t     size       = pairs[0].first->locally_owned_size();
    std::array<double, n> result{};
    for (std::size_t i = 0; i < size; i += block_size)
      {
        const std::size_t length = std::min(block_size, size - i);
        for (std::size_t k = 0; k < n; ++k)
          result[k] += inner_product({pairs[k].first->begin() + i, length},
                                     {pairs[k].second->begin() + i, length});
      }
    return result;
  }

  /// Inner products of several pairs of vectors, all of the same layout, with
  /// one message. Collective.
  template <std::size_t n>
  std::array<double, n>
  inner_products(
    const std::array<std::pair<const Vector *, const Vector *>, n> &pairs)
  {
    std::array<double, n> result = local_inner_products(pairs);
    sum_over_ranks(result, pairs[0].first->get_mpi_communicator());
    return result;
  }

  /**
   * The Euclidean norm. It is not finite if the vector is not, whereas
   * Vector::l2_norm() stops the program then in debug mode. Collective.
   */
  double
  norm(const Vector &vector);

  /// The norms of several vectors, with one message; the norm of a null pointer
  /// is 0. Collective.
  template <std::size_t n>
  std::array<double, n>
  norms(const std::array<const Vector *, n> &vectors)
  {
    std::array<double, n> result{};
    for (std::size_t i = 0; i < n; ++i)
      if (vectors[i] != nullptr)
        result[i] = local_inner_product(*vectors[i], *vectors[i]);
    sum_over_ranks(result, vectors[0]->get_mpi_communicator());
    for (double &value : result)
      value = std::sqrt(value);
    return result;
  }
} // namespace corotet

#endif
