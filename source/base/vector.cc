// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/vector.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  double
  inner_product(const std::span<const double> a,
                const std::span<const double> b)
  {
    // Several independent sums: additions need not wait for each other, and
    // round-off is that of shorter sums.
    constexpr std::size_t      n_sums = 16;
    const std::size_t          n      = a.size();
    std::array<double, n_sums> sums{};
    std::size_t                i = 0;
    for (; i + n_sums <= n; i += n_sums)
      for (std::size_t k = 0; k < n_sums; ++k)
        sums[k] += a[i + k] * b[i + k];
    for (std::size_t k = 0; i < n; ++i, ++k)
      sums[k] += a[i] * b[i];
    for (std::size_t half = n_sums / 2; half > 0; half /= 2)
      for (std::size_t k = 0; k < half; ++k)
        sums[k] += sums[k + half];
    return sums[0];
  }

  void
  sum_over_ranks(const std::span<double> values, const MPI_Comm comm)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(comm) > 1)
      MPI_Allreduce(
        MPI_IN_PLACE, values.data(), values.size(), MPI_DOUBLE, MPI_SUM, comm);
  }

  double
  norm(const Vector &vector)
  {
    return norms<1>({{&vector}})[0];
  }
} // namespace corotet
