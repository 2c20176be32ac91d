// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/epetra/amg.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace corotet
{
  void
  AMGParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Aggregation threshold",
                      aggregation_threshold,
                      "Strength of a coupling between nodes, relative to the "
                      "diagonal, below which it is ignored when nodes are "
                      "aggregated [-].",
                      dealii::Patterns::Double(0, 1));
    prm.add_parameter("Smoother sweeps",
                      smoother_sweeps,
                      "Degree of the Chebyshev smoother [-].",
                      dealii::Patterns::Integer(1, 20));
  }

  void
  AMG::build(const EffectiveOperator &A, const Vector &displacement)
  {
    build(A.matrix(), A.positions(displacement));
  }

  void
  AMG::build(const BlockMatrix &A, const Vector &positions)
  {
    const unsigned int n       = positions.locally_owned_size();
    const unsigned int n_nodes = n / 3;
    rigid_body_modes.assign(6 * static_cast<std::size_t>(n), 0.);
    for (unsigned int node = 0; node < n_nodes; ++node)
      for (unsigned int a = 0; a < 3; ++a)
        {
          // Translation in direction a, and rotation about axis a: e_a x r.
          const unsigned int b      = (a + 1) % 3;
          const unsigned int c      = (a + 2) % 3;
          double *translation       = &rigid_body_modes[std::size_t(a) * n];
          double *rotation          = &rigid_body_modes[std::size_t(3 + a) * n];
          translation[3 * node + a] = 1;
          rotation[3 * node + b]    = -positions.local_element(3 * node + c);
          rotation[3 * node + c]    = positions.local_element(3 * node + b);
        }

    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: threshold", parameters->aggregation_threshold);
    list.set("PDE equations", 3);
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", static_cast<int>(parameters->smoother_sweeps));
    list.set("smoother: pre or post", "both");
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 2000);
    list.set("initialize random seed", true);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", 6);
    list.set("null space: vectors", rigid_body_modes.data());
    if (!matrix || !matrix->shows(A))
      {
        // The old amg refers to the old matrix, so it goes first.
        amg.clear();
        matrix = std::make_unique<EpetraMatrix>(A);
      }
    amg.initialize(matrix->get(), list);
  }

  void
  AMG::vmult(Vector &dst, const Vector &src) const
  {
    amg.vmult(dst, src);
  }
} // namespace corotet
