// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_case_data_h
#define corotet_benchmarks_case_data_h

#include <corotet/operators/effective_operator.h>
#include <corotet/solvers/preconditioner.h>

#include <deal.II/lac/solver_cg.h>

#include <memory>
#include <optional>

#include "measure.h"
#include "problem.h"
#include "sparse_matrices.h"

namespace corotet::benchmarks
{
  /**
   * What the benchmarks of one case share, made when the first of them needs
   * it: the problem and its stiffness, matrix-free and assembled.
   */
  class CaseData
  {
  public:
    explicit CaseData(const Case &c)
      : description(c)
    {}

    const Case &
    which() const
    {
      return description;
    }

    std::string
    name(const std::string &benchmark) const
    {
      return description.label + "/" + benchmark;
    }

    Problem &
    problem();

    /// The operator K with clamped rows: c_K = 1, c_M = 0, with the rotations
    /// of the state of solves.
    EffectiveOperator &
    effective();

    /// The assembled matrix of that operator.
    const BlockMatrix &
    matrix();

    /// The same matrix in other formats. On one rank only.
    const CompressedRows &
    compressed_rows();
    const RegisterBlocks &
    blocks();

    /// Time [s] and memory [bytes] of the assembly of the matrix.
    const Counters &
    assembly_figures()
    {
      matrix();
      return figures;
    }

  private:
    Case                               description;
    std::unique_ptr<Problem>           the_problem;
    std::unique_ptr<EffectiveOperator> the_operator;
    std::optional<CompressedRows>      the_rows;
    std::optional<RegisterBlocks>      the_blocks;
    Counters                           figures;
  };

  /// The preconditioner with the name @p type, and with @p parameters as in its
  /// subsection.
  std::unique_ptr<Preconditioner>
  make_preconditioner(const std::string &type,
                      const std::string &parameters = "");

  /// Solves A x = b by conjugate gradients from x = 0 until the residual is
  /// @p tolerance times |b|. Returns the number of iterations.
  template <typename Operator>
  unsigned int
  conjugate_gradients(const Operator       &A,
                      Vector               &x,
                      const Vector         &b,
                      const Preconditioner &P,
                      const double          tolerance)
  {
    x = 0;
    dealii::SolverControl    control(20000, tolerance * b.l2_norm());
    dealii::SolverCG<Vector> cg(control);
    cg.solve(A, x, b, P);
    return control.last_step();
  }

  /// Adds y = K x: the matrix formats and the matrix-free operators.
  void
  add_operators(CaseData &data);

  /// Adds y = K x by deal.II's MatrixFree, for straight bodies.
  void
  add_deal_matrix_free(CaseData &data);

  /// Adds rotations, matrices, set-up and explicit steps of a deformed beam.
  void
  add_updates(CaseData &data);

  /// Adds linear static solves.
  void
  add_solvers(CaseData &data);

  /// Adds implicit steps in dynamics.
  void
  add_dynamics(CaseData &data);

  /// Adds solves by Trilinos with the assembled matrix; only with Epetra.
  void
  add_epetra(CaseData &data);

  /// Adds the peak memory of a process that does nothing else.
  void
  add_memory(CaseData &data);
} // namespace corotet::benchmarks

#endif
