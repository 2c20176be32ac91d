// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "case_data.h"

#include <deal.II/base/mpi.h>

namespace corotet::benchmarks
{
  namespace
  {
    double
    sum(const double value)
    {
      return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
    }
  } // namespace

  Problem &
  CaseData::problem()
  {
    if (!the_problem)
      the_problem = std::make_unique<Problem>(description);
    return *the_problem;
  }

  EffectiveOperator &
  CaseData::assembled()
  {
    if (!the_matrix)
      {
        Problem     &p           = problem();
        const double peak_before = peak_memory();
        const double before      = present_memory();
        figures["sparsity_s"]    = seconds([&] {
          the_matrix = std::make_unique<EffectiveOperator>(p.discretization,
                                                           p.reference,
                                                           p.elasticity,
                                                           p.mass,
                                                           p.is_prescribed);
        });
        figures["seconds"]       = seconds([&] { the_matrix->update(1., 0.); });
        figures["bytes"]         = sum(present_memory() - before);
        figures["peak_bytes"] =
          sum(std::max(peak_memory(), peak_before) - before);
        figures["unknowns"] = p.n_unknowns();
        figures["nonzeros"] =
          static_cast<double>(the_matrix->matrix().n_nonzero_elements());
      }
    return *the_matrix;
  }

  const BlockMatrix &
  CaseData::blocks()
  {
    if (!the_blocks)
      the_blocks.emplace(csr_view(assembled().matrix()));
    return *the_blocks;
  }
} // namespace corotet::benchmarks
