// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/direct.h>

namespace corotet
{
  void
  CholeskyDirect::build(const EffectiveOperator &A, const Vector &)
  {
    factors.factorize(A.matrix());
  }

  void
  CholeskyDirect::vmult(Vector &dst, const Vector &src) const
  {
    factors.vmult(dst, src);
  }
} // namespace corotet
