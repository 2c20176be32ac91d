// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_p_multigrid_h
#define corotet_solvers_p_multigrid_h

#include <corotet/discretization/cell_proportions.h>
#include <corotet/discretization/coarser_nodes.h>
#include <corotet/solvers/chebyshev.h>
#include <corotet/solvers/p_multigrid_parameters.h>
#include <corotet/solvers/preconditioner.h>
#include <corotet/solvers/vertex_level.h>

#include <memory>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * One V-cycle over the degrees p, p-1, .., 1, where an element with bubbles
   * comes before the one without, on the same cells (Weber, Mueller-Roemer,
   * Altenhofen, Stork, Fellner 2015): matrix-free and in single precision above
   * degree 1, with Chebyshev smoothers; degree 1 is solved by a sparse
   * factorisation of its assembled matrix, or one cycle of smoothed aggregation
   * on it.
   *
   * All levels have the cells in common, so they share one set of rotated
   * gradients: new rotations cost only a conversion to single precision and new
   * diagonals. The solver of degree 1 and the smoothers' eigenvalues stay those
   * of the last build().
   */
  class PMultigrid : public Preconditioner
  {
  public:
    explicit PMultigrid(const std::shared_ptr<PMultigridParameters> &
                          parameters = std::make_shared<PMultigridParameters>())
      : parameters(parameters)
    {}

    /// A copy has parameters of its own, with the same values, but nothing that
    /// has been built.
    PMultigrid(const PMultigrid &other)
      : Preconditioner()
      , parameters(std::make_shared<PMultigridParameters>(*other.parameters))
    {}

    PMultigrid &
    operator=(const PMultigrid &) = delete;
    ~PMultigrid() override        = default;

    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      parameters->declare_parameters(prm);
    }

    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    update(const EffectiveOperator &A) override;

    void
    transfer(Archive &archive) override;

    /// Measured costs were 4 to 8 iterations at degree 3, 8 to 13 at degree 2
    /// and 11 to 17 at degree 1.
    double
    build_cost() const override
    {
      return 10;
    }

    void
    vmult(Vector &dst, const Vector &src) const override;

    void
    vmult_with_norm(Vector       &dst,
                    const Vector &src,
                    const double  src_norm) const override;

    /// The estimates of the largest eigenvalue of D^{-1} A that the smoothers
    /// use since the last build(), the finest level first.
    std::vector<double>
    largest_eigenvalues() const;

    /// The level of degree 1; only after the first build().
    const VertexLevel &
    lowest_level() const
    {
      return *vertex_level;
    }

    /// Proportions of the body's cells; only after the first build().
    const CellProportions &
    proportions() const
    {
      return the_proportions;
    }

  private:
    using FloatVector = Chebyshev::FloatVector;

    /// A level above degree 1.
    struct Level
    {
      Level(const Nodes                      &nodes,
            const std::vector<unsigned char> &is_prescribed,
            const unsigned int                smoother_degree,
            const double                      smoothing_range);

      std::vector<unsigned char> is_prescribed;
      CellwiseOperator<float>    A;
      Chebyshev                  smoother;
      CoarserNodes               coarser;
      FloatVector                lumped_mass;
      FloatVector                x;
      FloatVector                b;
      FloatVector                residual;
      /// The operator's matrix of the surface; null if it has none.
      std::unique_ptr<SurfaceOperator<float>> surface;
    };

    void
    make_levels(const EffectiveOperator &A);
    void
    choose_units(const EffectiveOperator &A);
    void
    estimate_eigenvalues(const Discretization &discretization);
    void
    cycle(const unsigned int level) const;

    const std::shared_ptr<PMultigridParameters> parameters;

    /// The levels, finest first.
    std::vector<std::unique_ptr<Level>>            levels;
    dealii::AlignedVector<CellCoefficients<float>> coefficients;
    dealii::AlignedVector<CellMasses<float>>       masses;
    /// Units of the stiffness and of the mass in single precision.
    double stiffness_unit = 1;
    double mass_unit      = 1;
    /// The scale of the operator, by which vmult() divides.
    double scale = 1;

    CellProportions              the_proportions;
    std::unique_ptr<VertexLevel> vertex_level;
    /// Whether the first factors are in double precision, as they were before a
    /// restart.
    bool begins_in_double = false;
  };
} // namespace corotet

#endif
