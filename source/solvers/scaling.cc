// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/scaling.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  double
  power_of_two(const double size)
  {
    if (!(size > 0) || !std::isfinite(size))
      return 1;
    // The limits keep the inverse finite.
    return std::ldexp(1., std::clamp(std::ilogb(size), -1000, 1000));
  }

  double
  unit_of(const BlockMatrix &A)
  {
    return power_of_two(
      dealii::Utilities::MPI::max(A.largest_value(),
                                  A.pattern()->communicator()));
  }
} // namespace corotet
