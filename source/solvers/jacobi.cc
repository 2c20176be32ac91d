// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/jacobi.h>

namespace corotet
{
  void
  Jacobi::build(const EffectiveOperator &A, const Vector &)
  {
    update(A);
  }

  void
  Jacobi::update(const EffectiveOperator &A)
  {
    Vector inverse(A.diagonal());
    for (unsigned int i = 0; i < inverse.locally_owned_size(); ++i)
      inverse.local_element(i) = 1. / A.diagonal().local_element(i);
    inverse_diagonal.reinit(inverse);
  }

  void
  Jacobi::vmult(Vector &dst, const Vector &src) const
  {
    inverse_diagonal.vmult(dst, src);
  }
} // namespace corotet
