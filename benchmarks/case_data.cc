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
  CaseData::effective()
  {
    if (!the_operator)
      {
        Problem &p   = problem();
        the_operator = std::make_unique<EffectiveOperator>(
          p.discretization, p.elasticity, p.mass, p.motion.is_prescribed());
        the_operator->update(1., 0.);
      }
    return *the_operator;
  }

  const BlockMatrix &
  CaseData::matrix()
  {
    EffectiveOperator &A = effective();
    if (figures.empty())
      {
        const double peak_before = peak_memory();
        const double before      = present_memory();
        const double first       = seconds([&] { A.matrix(); });
        figures["bytes"]         = sum(present_memory() - before);
        figures["peak_bytes"] =
          sum(std::max(peak_memory(), peak_before) - before);
        A.update(1., 0.);
        figures["seconds"]    = seconds([&] { A.matrix(); });
        figures["sparsity_s"] = first - figures["seconds"];
        figures["unknowns"]   = problem().n_unknowns();
        figures["nonzeros"]   = sum(A.matrix().n_values());
      }
    return A.matrix();
  }

  const CompressedRows &
  CaseData::compressed_rows()
  {
    // matrix() restores its values, as an earlier benchmark may have left those
    // of a deformed body.
    const BlockMatrix &values = matrix();
    if (!the_rows)
      the_rows.emplace(values);
    return *the_rows;
  }

  const RegisterBlocks &
  CaseData::blocks()
  {
    if (!the_blocks)
      the_blocks.emplace(compressed_rows().view());
    return *the_blocks;
  }
} // namespace corotet::benchmarks
