// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/vector.h>

#include <deal.II/base/mpi.h>

#include <cmath>

namespace corotet
{
  double
  norm(const Vector &vector)
  {
    double sum = 0;
    for (unsigned int i = 0; i < vector.locally_owned_size(); ++i)
      sum += vector.local_element(i) * vector.local_element(i);
    return std::sqrt(
      dealii::Utilities::MPI::sum(sum, vector.get_mpi_communicator()));
  }
} // namespace corotet
