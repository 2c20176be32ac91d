// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_vertex_level_h
#define corotet_solvers_vertex_level_h

#include <corotet/discretization/cell_proportions.h>
#include <corotet/discretization/coarser_nodes.h>
#include <corotet/operators/assembled_matrix.h>
#include <corotet/operators/effective_operator.h>
#include <corotet/solvers/p_multigrid_parameters.h>
#include <corotet/solvers/smoothed_aggregation.h>
#include <corotet/solvers/sparse_cholesky.h>
#include <corotet/solvers/vertex_motions.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The lowest level of PMultigrid, whose matrix is assembled: degree 1, and
   * where cells are flat or stretched with the rotations of the vertices, too
   * (VertexMotions). A sparse factorisation solves it, or one cycle of smoothed
   * aggregation.
   */
  class VertexLevel
  {
  public:
    using FloatVector = VertexMotions::FloatVector;

    /// The level of @p A, if that is of degree 1; else the level below the
    /// element @p quadratic of degree 2, whose vertices are @p coarser, and
    /// whose prescribed unknowns are @p is_prescribed. @p finest_nodes has the
    /// local numbers of the owned vertices among the nodes of A. All others
    /// must outlive this object. Collective.
    VertexLevel(const PMultigridParameters       &parameters,
                const EffectiveOperator          &A,
                const CellProportions            &proportions,
                const Nodes                      *quadratic,
                const CoarserNodes               *coarser,
                const std::vector<unsigned char> &is_prescribed,
                std::vector<unsigned int>         finest_nodes);

    /// Takes over A / @p scale. @p displacement is that of the finest nodes
    /// [m]. Collective.
    void
    build(const EffectiveOperator &A,
          const double             scale,
          const Vector            &displacement);

    /// to = A^{-1} from, approximately, if A is of degree 1. @p norm is that of
    /// @p from, and not 0. Collective.
    void
    vmult(Vector &to, const Vector &from, const double norm) const;

    /// fine += P A^{-1} P^T residual, approximately, for the quadratic element;
    /// zero at prescribed unknowns, where both arguments must be zero. The
    /// residual's size must be about one. Collective.
    void
    correct(FloatVector &fine, const FloatVector &residual) const;

    /// The size of a sparse factorisation of the matrix of degree 1 without
    /// rotations, whether it is made or not: floating-point operations and
    /// entries.
    struct Factorization
    {
      double n_unknowns, n_operations, n_entries;
    };

    /// The size of the factorisation; only after build(). Collective.
    Factorization
    factorization(const EffectiveOperator &A) const;

    /// Whether a factorisation solves this level.
    bool
    has_factors() const
    {
      return solver == "direct";
    }

    /// Whether the factors, or those of the last level of aggregation, are in
    /// double precision, because single had failed.
    bool
    is_in_double() const
    {
      const SparseCholesky &factor =
        has_factors() ? direct : aggregation.factor_of_last_level();
      return factor.precision() == SparseCholesky::Precision::double_precision;
    }

    /// Makes the first factors in double precision, too.
    void
    begin_in_double()
    {
      direct.begin_in_double();
      aggregation.factor_of_last_level().begin_in_double();
    }

    /// Whether vertices have rotations.
    bool
    has_rotations() const
    {
      return motions != nullptr;
    }

  private:
    Coarsening
    coarsening_for(const CellProportions &cells) const;
    bool
    wants_rotations(const CellProportions &cells) const;
    /// Whether factors of A, the matrix of this level, are small enough to pay.
    bool
    factors_pay(const BlockMatrix &A);
    const BlockMatrix &
    matrix(const EffectiveOperator &A) const;
    void
    assemble(const EffectiveOperator &A,
             const double             scale,
             const Vector            &displacement);
    /// Owned entries are float or double; @p size is about that of @p from.
    template <typename Number>
    void
    solve(Number *to, const Number *from, const double size) const;

    const PMultigridParameters &parameters;
    /// Null if A is of degree 1.
    const Nodes              *quadratic;
    const CoarserNodes       *coarser;
    const Nodes              &vertices;
    std::vector<unsigned int> finest_nodes;
    /// Local prescribed unknowns of vertices.
    std::vector<unsigned int> prescribed;
    bool                      is_thin_body = false;
    /// Whether the matrix couples more nodes than those that share a cell.
    bool couples_further = false;

    /// One of these is used, or none if A is of degree 1.
    std::unique_ptr<AssembledMatrix> assembled;
    std::unique_ptr<VertexMotions>   motions;

    std::string         solver;
    SparseCholesky      direct{SparseCholesky::Precision::single_precision};
    SmoothedAggregation aggregation;
    /// The further solver, if one is asked for.
    std::unique_ptr<CoarseSolver> other;

    /// Work space for the further solver; empty without one.
    mutable Vector             x, b;
    mutable FloatVector        float_x, float_b;
    mutable std::vector<float> unknowns;
  };
} // namespace corotet

#endif
