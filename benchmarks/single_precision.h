// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_single_precision_h
#define corotet_benchmarks_single_precision_h

#include <corotet/operators/effective_operator.h>

namespace corotet::benchmarks
{
  /**
   * The stiffness K of an effective operator in single precision, with vectors
   * to apply it to. @p A must outlive this object.
   */
  class SinglePrecision
  {
  public:
    explicit SinglePrecision(const EffectiveOperator &A)
      : cells(A.discretization().batches().n_owned_batches() / floats_per_batch)
      , stiffness(A.discretization(), marked_unknowns(A.is_prescribed()))
    {
      const auto &from = A.elasticity().coefficients();
      for (unsigned int b = 0; b < cells.size() * floats_per_batch; ++b)
        {
          auto &cell = cells[b / floats_per_batch];
          for (unsigned int lane = 0; lane < batch_size; ++lane)
            {
              const unsigned int to = b % floats_per_batch * batch_size + lane;
              for (unsigned int i = 0; i < 9; ++i)
                cell.gradients[i][to] = from[b].gradients[i][lane];
              cell.lame_ratio[to] = from[b].lame_ratio[lane];
            }
        }
      stiffness.set_terms(1., cells.data(), 0., nullptr, nullptr);
      stiffness.compute_diagonal();
      A.discretization().initialize_vector(x);
      A.discretization().initialize_vector(y);
    }

    /// y = K x.
    void
    apply()
    {
      stiffness.vmult(y, x);
    }

  private:
    dealii::AlignedVector<CellCoefficients<float>> cells;
    CellwiseOperator<float>                        stiffness;

  public:
    dealii::LinearAlgebra::distributed::Vector<float> x;
    dealii::LinearAlgebra::distributed::Vector<float> y;
  };
} // namespace corotet::benchmarks

#endif
