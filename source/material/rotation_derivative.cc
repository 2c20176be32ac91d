// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/rotation_derivative.h>

#include <algorithm>
#include <cmath>

namespace corotet::internal
{
  ClampedInverse
  clamped_inverse(const dealii::SymmetricTensor<2, 3> &G)
  {
    ClampedInverse result{{}, true};
    if (!std::isfinite(G.norm()))
      return result;
    result.is_clamped = false;
    for (const auto &[value, direction] :
         eigenvectors(G, dealii::SymmetricTensorEigenvectorMethod::jacobi))
      {
        result.inverse += symmetrize(outer_product(direction, direction)) /
                          std::max(value, smallest_sum_of_stretches);
        result.is_clamped =
          result.is_clamped || value < smallest_sum_of_stretches;
      }
    return result;
  }
} // namespace corotet::internal
