// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/direct.h>

#include <Amesos.h>

namespace corotet
{
  void
  Direct::build(const EffectiveOperator &A, const Vector &)
  {
    using dealii::TrilinosWrappers::SolverDirect;
    const std::string solver =
      Amesos().Query("Amesos_Mumps") ? "Amesos_Mumps" : "Amesos_Klu";
    factors = std::make_unique<SolverDirect>(
      control, SolverDirect::AdditionalData(false, solver));
    factors->initialize(A.matrix());
  }

  void
  Direct::clear()
  {
    factors.reset();
  }

  void
  Direct::vmult(Vector &dst, const Vector &src) const
  {
    factors->solve(dst, src);
  }
} // namespace corotet
