// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/scaling.h>

#include <Epetra_Comm.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  double
  power_of_two(const double size)
  {
    if (!(size > 0) || !std::isfinite(size))
      return 1;
    // Also the inverse is to be a number.
    return std::ldexp(1., std::clamp(std::ilogb(size), -1000, 1000));
  }

  double
  unit_of(const Epetra_CrsMatrix &A)
  {
    double own = 0, largest;
    for (int row = 0; row < A.NumMyRows(); ++row)
      {
        int     length;
        double *values;
        A.ExtractMyRowView(row, length, values);
        for (int k = 0; k < length; ++k)
          own = std::max(own, std::abs(values[k]));
      }
    A.Comm().MaxAll(&own, &largest, 1);
    return power_of_two(largest);
  }
} // namespace corotet
