// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_mass_solver_h
#define corotet_solvers_mass_solver_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>
#include <corotet/discretization/prescribed_motion.h>
#include <corotet/operators/mass.h>
#include <corotet/operators/surface_matrix.h>

#include <deal.II/lac/diagonal_matrix.h>

namespace corotet
{
  /**
   * Solves M a = r for the unknowns that are not prescribed: by a division if
   * the mass is lumped, else by conjugate gradients with the diagonal as
   * preconditioner. The scaled mass matrix is well conditioned, with bounds
   * that depend on the degree only [Wathen, Realistic eigenvalue bounds for the
   * Galerkin mass matrix, 1987], so the number of iterations does not grow with
   * the mesh.
   *
   * The arguments of the constructor must outlive this object.
   */
  class MassSolver
  {
  public:
    MassSolver(const Discretization   &discretization,
               const Mass             &mass,
               const PrescribedMotion &motion);

    /// Prescribed entries of @p a come out as zero, those of @p r must be zero.
    /// If r is not finite, neither is a. Returns the number of iterations.
    /// Throws ComputationError if the residual does not fall to 1e-13 of r.
    /// Collective.
    unsigned int
    solve(Vector &a, const Vector &r) const;

    /**
     * Solves (@p c_M M + S) a = r by conjugate gradients. If the mass is
     * lumped, only the entries of the nodes on which @p S acts are read and
     * written.
     */
    unsigned int
    solve(Vector                        &a,
          const Vector                  &r,
          const double                   c_M,
          const SurfaceOperator<double> &S) const;

    /// 1 / M_ii, zero where the unknown is prescribed.
    const Vector &
    inverse_diagonal_vector() const
    {
      return inverse_diagonal.get_vector();
    }

    /// dst = M src for the free unknowns. Collective.
    void
    vmult(Vector &dst, const Vector &src) const;

  private:
    /// Calls @p function(i) for the owned unknowns that the matrix couples:
    /// those of S if the mass is lumped, else all of them.
    template <typename Function>
    void
    for_each_coupled(const SurfaceOperator<double> &S,
                     const Function                &function) const;
    /// product = (c_M M + S) x for these unknowns, zero where prescribed.
    void
    multiply(const Vector                  &x,
             const double                   c_M,
             const SurfaceOperator<double> &S) const;

    const Mass             &mass;
    const PrescribedMotion &motion;
    /// 1 / M_ii, zero where the unknown is prescribed.
    dealii::DiagonalMatrix<Vector> inverse_diagonal;
    mutable Vector                 ghosted;
    /// Work space for solves with a matrix of the surface: residual, direction,
    /// product and inverse diagonal.
    mutable Vector residual, direction, product, inverse;
  };
} // namespace corotet

#endif
