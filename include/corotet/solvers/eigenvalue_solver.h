// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_eigenvalue_solver_h
#define corotet_solvers_eigenvalue_solver_h

#include <corotet/solvers/linear_solver.h>

#include <functional>
#include <random>
#include <vector>

namespace corotet
{
  /**
   * Solutions of K x = lambda M x, smallest lambda first.
   */
  struct Eigenpairs
  {
    /// lambda [1/s^2]; there may be more than vectors.
    std::vector<double> values;
    /// x with x . M x = 1, zero where x is prescribed. Without ghost values.
    std::vector<Vector> vectors;
  };

  /**
   * The smallest eigenvalues of K x = lambda M x on the unknowns that are not
   * prescribed, by the block Krylov-Schur method (@cite stewart2001) of Anasazi
   * for A^{-1} M with A = K + s M: with a shift s > 0, A is positive definite
   * also where K has rigid body modes. These are known, come first, and are
   * kept out of the search.
   *
   * Multiple eigenvalues are found by blocks, and because the search is
   * repeated among vectors orthogonal to all that were found, until its result
   * is no smaller than these.
   *
   * The arguments of the constructor must outlive this object. Members are
   * collective.
   */
  class EigenvalueSolver
  {
  public:
    /**
     * @p A is updated here, and must be the operator of a body at rest. If it
     * has a matrix of the surface, that is part of K. @p tolerance is that of
     * the residuals of A^{-1} M x = x / (lambda + s), relative to 1 / (lambda +
     * s) in the norm of M. @p null_space has a basis of all x with K x = 0,
     * without ghost values. After each linear solve @p progress is called with
     * their number.
     */
    EigenvalueSolver(EffectiveOperator                       &A,
                     LinearSolver                            &linear_solver,
                     const double                             tolerance,
                     std::vector<Vector>                      null_space,
                     const std::function<void(unsigned int)> &progress);

    /// Number of unknowns that are not prescribed, over all ranks.
    dealii::types::global_dof_index
    n_free_unknowns() const
    {
      return n_free;
    }

    /// The largest number of eigenvalues that can be asked for: a quarter of
    /// the unknowns, as higher ones are properties of the mesh and not of the
    /// body. It is zero with fewer than 16 unknowns, which leave no room for a
    /// search.
    unsigned int
    max_eigenvalues() const
    {
      return n_free < 16 ? 0 : n_free / 4;
    }

    /// An estimate of the smallest eigenvalue [1/s^2] among x orthogonal to the
    /// linearly independent @p motions, which have no ghost values and include
    /// the null space: the Rayleigh quotient after three steps of inverse
    /// iteration with @p shift, from a random vector. It is an upper bound,
    /// mostly by less than a factor of two if the shift is not above it. With
    /// @p of_strain the quotient only has the energy of strain: the remainder
    /// of a mode without such motions moves on elastic supports as no mode
    /// does, so their energy may be anything.
    double
    lowest_eigenvalue(const double        shift,
                      std::vector<Vector> motions,
                      const bool          of_strain);

    /**
     * Finds the @p n smallest eigenpairs, 1 to max_eigenvalues(), and the
     * values of some further ones, if @p n is larger than the null space.
     * @p shift is s > 0 [1/s^2], best somewhat below the smallest eigenvalue of
     * a mode that deforms the body. Throws ComputationError if they are not
     * found.
     */
    Eigenpairs
    solve(const unsigned int n, const double shift);

    /// f = K x, including the operator's matrix of the surface, and g = M x,
    /// both zero where x is prescribed. x must not have ghost values.
    void
    apply(Vector &f, Vector &g, const Vector &x) const;

    /// The number of linear solves so far.
    unsigned int
    n_linear_solves() const
    {
      return n_solves;
    }

    unsigned int
    n_linear_iterations() const
    {
      return n_iterations;
    }

  private:
    class ShiftedInverse;
    class FreeMass;

    /// Vectors that are orthonormal in the inner product of M, and their
    /// products with M.
    struct Basis
    {
      std::vector<Vector> vectors;
      std::vector<Vector> M_vectors;

      /// Makes x orthogonal to these vectors.
      void
      remove_from(Vector &x) const;
    };

    /// The orthonormal basis of the linearly independent @p vectors, in their
    /// order.
    Basis
    orthonormal(std::vector<Vector> vectors);
    /// Finds up to @p n pairs orthogonal to the null space and to @p others.
    Eigenpairs
    search(const unsigned int n,
           const double       shift,
           const double       tolerance,
           const Eigenpairs  &others);
    /// Improves the @p n lowest pairs by a step of inverse iteration.
    void
    refine(Eigenpairs &pairs, const unsigned int n);
    /// Makes @p pairs solutions of the problem in the space of their vectors.
    void
    rayleigh_ritz(Eigenpairs &pairs) const;
    /// x = A^{-1} M x.
    void
    apply_inverse(Vector &x);
    void
    set_zero(Vector &x) const;

    EffectiveOperator                &A;
    LinearSolver                     &linear_solver;
    double                            tolerance;
    std::function<void(unsigned int)> progress;
    dealii::types::global_dof_index   n_free;
    Basis                             null_space;
    /// Owned unknowns that are not prescribed.
    std::vector<unsigned int> free;
    /// Each search starts from other random vectors: if a mode was missed, the
    /// same ones would miss it again.
    std::minstd_rand generator;
    unsigned int     n_solves     = 0;
    unsigned int     n_iterations = 0;
    mutable Vector   ghosted;
    Vector           right_side;
  };
} // namespace corotet

#endif
