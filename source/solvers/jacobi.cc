// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/jacobi.h>

namespace corotet
{
  void
  Jacobi::build(const EffectiveOperator &A, const Vector &positions)
  {
    Vector inverse(positions);
    for (const auto dof : inverse.locally_owned_elements())
      inverse(dof) = 1. / A.matrix().diag_element(dof);
    inverse_diagonal.reinit(inverse);
  }

  void
  Jacobi::clear()
  {
    inverse_diagonal.clear();
  }

  void
  Jacobi::vmult(Vector &dst, const Vector &src) const
  {
    inverse_diagonal.vmult(dst, src);
  }
} // namespace corotet
