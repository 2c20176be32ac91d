// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/mpi.h>


namespace corotet
{
  void
  SmoothedAggregation::build(const BlockMatrix &A, const double *positions)
  {
    build_from_finest(A, nullptr, positions);
  }

  void
  SmoothedAggregation::build(BlockMatrix &&A, const double *positions)
  {
    build_from_finest(A, &A, positions);
  }

  void
  SmoothedAggregation::build_from_finest(const BlockMatrix &A,
                                         BlockMatrix       *given_up,
                                         const double      *positions)
  {
    const int n_nodes = A.pattern()->n_owned();
    communicator      = A.pattern()->communicator();
    n_unknowns        = 3 * n_nodes;
    is_of_aggregates  = false;
    std::vector<PointFrame<3>> frames(n_nodes);
    for (int i = 0; i < n_nodes; ++i)
      for (int a = 0; a < 3; ++a)
        frames[i].centre[a] = positions[3 * i + a];
    finest.build(A, given_up, A.pattern(), frames, coarsening);
    build_coarser(&finest.coarse());
  }

  void
  SmoothedAggregation::build(const AggregateProblem &A)
  {
    communicator     = A.aggregates->communicator();
    n_unknowns       = 6 * A.aggregates->n_owned();
    is_of_aggregates = true;
    build_coarser(&A);
  }

  void
  SmoothedAggregation::build_coarser(const AggregateProblem *problem)
  {
    unsigned int n_above    = 0;
    Coarsening   of_coarser = coarsening;
    of_coarser.n_joined     = 1;
    // Levels copy what they need of a matrix, which is then given up. A matrix
    // of aggregates that was passed to build() stays.
    const auto given_up = [&]() -> BlockMatrix * {
      return is_of_aggregates && n_above == 0 ? nullptr : problem->matrix.get();
    };
    for (; problem->aggregates != nullptr; ++n_above)
      {
        if (n_above == coarser.size())
          coarser.push_back(std::make_unique<AggregationLevel<6>>(degree));
        coarser[n_above]->build(*problem->matrix,
                                given_up(),
                                problem->aggregates,
                                problem->frames,
                                of_coarser);
        problem = &coarser[n_above]->coarse();
      }
    coarser.resize(n_above);
    last_unknowns.resize(6 * problem->frames.size());
    last_factor.factorize(*problem->matrix);
    if (BlockMatrix *const matrix = given_up())
      matrix->release_values();
  }

  template <typename Level>
  void
  SmoothedAggregation::cycle(const Level       &level,
                             const unsigned int n_above,
                             const bool         x_is_zero) const
  {
    // A second cycle of the levels below costs little and keeps iterations from
    // growing with their number. On flat and stretched cells it is left out, as
    // in single precision it adds to the errors there.
    const int n_cycles = coarsening.least_similarity > 0 ? 1 : 2;
    level.smooth(x_is_zero);
    if (n_above < coarser.size())
      {
        const AggregationLevel<6> &next = *coarser[n_above];
        level.restrict_residual(next.right_hand_side());
        for (int n = 0; n < n_cycles; ++n)
          cycle(next, n_above + 1, n == 0);
        level.prolongate_add(next.solution());
      }
    else
      {
        level.restrict_residual(last_unknowns.data());
        last_factor.vmult(last_unknowns.data(), last_unknowns.data());
        level.prolongate_add(last_unknowns.data());
      }
    level.smooth(false);
  }

  template <typename Number>
  void
  SmoothedAggregation::vmult(Number       *dst,
                             const Number *src,
                             const double  size) const
  {
    // Numbers are scaled to about 1, so that no product leaves the range of
    // float.
    const Number scale   = size;
    const auto   through = [&](const auto &level, const unsigned int n_above) {
      const Number back = scale / level.unit();
      float *const rhs  = level.right_hand_side();
      for (int i = 0; i < n_unknowns; ++i)
        rhs[i] = src[i] / scale;
      cycle(level, n_above, true);
      const float *const x = level.solution();
      for (int i = 0; i < n_unknowns; ++i)
        dst[i] = back * x[i];
    };
    if (is_of_aggregates)
      through(*coarser.front(), 1);
    else
      through(finest, 0);
  }

  std::vector<int>
  SmoothedAggregation::n_aggregates() const
  {
    std::vector<int> result;
    if (!is_of_aggregates)
      result.push_back(finest.n_aggregates());
    for (const auto &level : coarser)
      result.push_back(level->n_aggregates());
    return result;
  }

  template void
  SmoothedAggregation::vmult(float *, const float *, const double) const;
  template void
  SmoothedAggregation::vmult(double *, const double *, const double) const;
} // namespace corotet
