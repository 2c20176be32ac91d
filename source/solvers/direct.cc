// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/operators/tangent_operator.h>
#include <corotet/solvers/direct.h>
#include <corotet/solvers/linear_solver_errors.h>

namespace corotet
{
  void
  CholeskyDirect::build(const EffectiveOperator &A, const Vector &)
  {
    factors.factorize(A.matrix());
  }

  bool
  CholeskyDirect::factorize(const BlockMatrix &matrix)
  {
    try
      {
        factors.factorize(matrix);
      }
    catch (const SingularMatrixError &)
      {
        return false;
      }
    return true;
  }

  void
  CholeskyDirect::build_for(const EffectiveOperator &A,
                            const TangentOperator   *J,
                            const Vector            &displacement)
  {
    // Where the stresses of an iterate make the tangent indefinite, some more
    // of the frozen stiffness makes it definite while keeping the effect of the
    // stresses, which in thin bodies may be a thousand times the bending
    // stiffness.
    is_of_tangent = true;
    is_makeshift  = false;
    if (J != nullptr && J->has_matrix())
      for (const double n_frozen : {0., 3., 15., 63.})
        {
          if (factorize(J->matrix(n_frozen)))
            return;
          is_makeshift = true;
        }
    is_of_tangent = false;
    build(A, displacement);
  }

  void
  CholeskyDirect::vmult(Vector &dst, const Vector &src) const
  {
    factors.vmult(dst, src);
  }
} // namespace corotet
