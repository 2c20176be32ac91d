// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_solvers_epetra_amg_h
#define corotet_solvers_epetra_amg_h

#include <corotet/solvers/coarse_solver.h>
#include <corotet/solvers/epetra/epetra_matrix.h>
#include <corotet/solvers/preconditioner.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <memory>
#include <vector>

namespace corotet
{
  /**
   * The parameters of AMG, which are also used where it is the coarse solver of
   * p-multigrid.
   */
  struct AMGParameters
  {
    void
    declare_parameters(dealii::ParameterHandler &prm);

    double       aggregation_threshold = 1e-4;
    unsigned int smoother_sweeps       = 2;
  };

  /**
   * One V-cycle of smoothed aggregation (Trilinos ML) on the assembled matrix,
   * with the six rigid body modes of the current configuration as near null
   * space (Vanek, Mandel, Brezina 1996).
   */
  class AMG : public Preconditioner, public CoarseSolver
  {
  public:
    explicit AMG(const std::shared_ptr<AMGParameters> &parameters =
                   std::make_shared<AMGParameters>())
      : parameters(parameters)
    {}

    /// A copy has parameters of its own, with the same values, and no matrix.
    AMG(const AMG &other)
      : Preconditioner()
      , CoarseSolver()
      , parameters(std::make_shared<AMGParameters>(*other.parameters))
    {}

    AMG &
    operator=(const AMG &) = delete;
    ~AMG() override        = default;

    void
    declare_parameters(dealii::ParameterHandler &prm) override
    {
      parameters->declare_parameters(prm);
    }

    void
    build(const EffectiveOperator &A, const Vector &displacement) override;

    void
    build(const BlockMatrix &A, const Vector &positions) override;

    void
    vmult(Vector &dst, const Vector &src) const override;

  private:
    const std::shared_ptr<AMGParameters> parameters;

    // The matrix outlives amg, which refers to it.
    std::unique_ptr<EpetraMatrix> matrix;
    /// Six vectors of the owned unknowns, one after another.
    std::vector<double>                       rigid_body_modes;
    dealii::TrilinosWrappers::PreconditionAMG amg;
  };
} // namespace corotet

#endif
