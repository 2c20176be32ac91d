// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>
#include <corotet/solvers/aggregation_level.h>
#include <corotet/solvers/largest_eigenvalue.h>
#include <corotet/solvers/scaling.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Dense>

namespace corotet
{
  template <int d>
  AggregationLevel<d>::AggregationLevel(const unsigned int degree)
    : degree(degree)
  {}

  template <int d>
  void
  AggregationLevel<d>::build(const BlockMatrix &A,
                             BlockMatrix       *given_up,
                             const std::shared_ptr<const BlockPattern> &pattern,
                             const std::vector<PointFrame<d>>          &frames,
                             const Coarsening &coarsening)
  {
    const bool is_new = points != pattern;
    if (is_new)
      {
        points   = pattern;
        n_points = points->n_owned();
        for (auto *vector : {&rhs, &residual, &product, &scaled})
          vector->resize(offset(n_points));
        for (auto *vector : {&x, &direction})
          vector->resize(offset(points->exchange().n_items()));
      }
    // Matrices of aggregates have been divided by the unit already.
    if (d == 3)
      the_unit = unit_of(A);
    // The reserve has room for the motions, see below, which may need more than
    // the blocks: pages that nothing is written to take no memory.
    blocks.reserve(5 * offset(d) * points->graph().columns.size() / 4);
    copy_blocks(A);
    copy_diagonal(A);
    if (is_new)
      {
        const bool has_blocks = coarsening.least_similarity > 0;
        has_aggregate_blocks  = false;
        if (has_blocks)
          estimate_largest_eigenvalue();
        set_up_pattern(coarsening, frames);
        has_aggregate_blocks = has_blocks;
      }
    if (has_aggregate_blocks)
      invert_aggregates(A);
    estimate_largest_eigenvalue();
    // The blocks give their place to the motions and are copied once more
    // afterwards, which costs little.
    blocks.clear();
    build_coarse(A, frames);
    copy_blocks(A, given_up);
    if (given_up != nullptr)
      given_up->release_values();
  }

  template <int d>
  void
  AggregationLevel<d>::copy_blocks(const BlockMatrix &A, BlockMatrix *given_up)
  {
    const NodeGraph &graph = points->graph();
    // Loading the last column reads some numbers beyond it.
    blocks.resize_fast(offset(d) * graph.columns.size() + 2);
    std::fill(blocks.end() - 2, blocks.end(), 0.f);
    float                     *block = blocks.data();
    std::optional<LastReading> reading;
    if (given_up != nullptr && n_points > 0)
      reading.emplace(given_up->row(0, 0));
    for (int i = 0; i < n_points; ++i)
      {
        const auto rows = A.template rows_of<d>(i);
        if (reading)
          reading->passed(rows[0]);
        const int n = graph.starts[i + 1] - graph.starts[i];
        for (int k = 0; k < n; ++k, block += offset(d))
          for (int a = 0; a < d; ++a)
            for (int b = 0; b < d; ++b)
              block[d * b + a] = rows[a][d * k + b] / the_unit;
      }
  }

  template <int d>
  void
  AggregationLevel<d>::copy_diagonal(const BlockMatrix &A)
  {
    using Block            = Eigen::Matrix<double, d, d>;
    const NodeGraph &graph = points->graph();
    inverse_diagonal.resize(d * offset(n_points));
    is_prescribed.resize(offset(n_points));
    for (int i = 0; i < n_points; ++i)
      {
        const auto rows   = A.template rows_of<d>(i);
        const int  length = offset(graph.starts[i + 1] - graph.starts[i]);
        const int  own    = d * points->place(i, i);
        Block      diagonal;
        for (int a = 0; a < d; ++a)
          {
            double row_sum = 0;
            for (int k = 0; k < length; ++k)
              row_sum += std::abs(rows[a][k]);
            is_prescribed[d * i + a] = row_sum == std::abs(rows[a][own + a]);
            for (int b = 0; b < d; ++b)
              diagonal(a, b) = rows[a][own + b] / the_unit;
          }
        const Block inverse = diagonal.inverse();
        for (int a = 0; a < d; ++a)
          for (int b = 0; b < d; ++b)
            inverse_diagonal[d * d * i + d * b + a] = inverse(a, b);
      }
  }

  template <int d>
  void
  AggregationLevel<d>::invert_aggregates(const BlockMatrix &A)
  {
    const NodeGraph &graph   = points->graph();
    std::size_t      largest = 0;
    starts_of_inverses.assign(1, 0);
    for (int g = 0; g < points_of_aggregates.n_rows(); ++g)
      {
        const std::size_t n = offset(points_of_aggregates.starts[g + 1] -
                                     points_of_aggregates.starts[g]);
        largest             = std::max(largest, n);
        starts_of_inverses.push_back(starts_of_inverses.back() + n * n);
      }
    inverse_aggregates.resize(starts_of_inverses.back());
    block_product.resize(largest);
    // The place of each point in its aggregate.
    std::vector<int> places(n_points);
    for (int g = 0; g < points_of_aggregates.n_rows(); ++g)
      {
        const int  begin = points_of_aggregates.starts[g];
        const int  n     = points_of_aggregates.starts[g + 1] - begin;
        const int *own   = &points_of_aggregates.columns[begin];
        for (int i = 0; i < n; ++i)
          places[own[i]] = i;
        dealii::LAPACKFullMatrix<double> inverse(d * n, d * n);
        std::vector<double>              diagonal(offset(n));
        for (int i = 0; i < n; ++i)
          {
            const auto rows  = A.template rows_of<d>(own[i]);
            const int  first = graph.starts[own[i]];
            for (int k = first; k < graph.starts[own[i] + 1]; ++k)
              if (const int j = graph.columns[k];
                  j < n_points && aggregates[j] == aggregates[own[i]])
                for (int a = 0; a < d; ++a)
                  for (int b = 0; b < d; ++b)
                    inverse(d * i + a, d * places[j] + b) =
                      rows[a][d * (k - first) + b] / the_unit;
          }
        for (int i = 0; i < d * n; ++i)
          diagonal[i] = inverse(i, i);
        inverse.set_property(dealii::LAPACKSupport::symmetric);
        try
          {
            inverse.invert();
          }
        // The block is singular if a body is held nowhere and is one aggregate.
        catch (const dealii::ExceptionBase &)
          {
            inverse = 0.;
            for (int i = 0; i < d * n; ++i)
              inverse(i, i) = 1 / diagonal[i];
          }
        float *target = &inverse_aggregates[starts_of_inverses[g]];
        for (int j = 0; j < d * n; ++j)
          for (int i = 0; i < d * n; ++i)
            *target++ = inverse(i, j);
      }
  }

  template <int d>
  void
  AggregationLevel<d>::fill_without_pattern(std::vector<float> &values,
                                            const unsigned int  number) const
  {
    unsigned int seed =
      1 + dealii::Utilities::MPI::this_mpi_process(points->communicator()) +
      1000003u * number;
    for (int i = 0; i < d * n_points; ++i)
      {
        seed      = 1664525u * seed + 1013904223u;
        values[i] = (seed >> 8) * 0x1p-24f - 0.5f;
      }
  }

  /// Estimates the largest eigenvalue of D^-1 A: ten steps of Lanczos' method,
  /// and a margin.
  template <int d>
  void
  AggregationLevel<d>::estimate_largest_eigenvalue()
  {
    constexpr int       n_steps = 10;
    const int           n       = d * n_points;
    std::vector<double> diagonal, beside;
    std::vector<float> &r = rhs, &z = residual, &p = direction;
    const auto          dot = [&](const auto &u, const auto &v) {
      double own = 0;
      for (int i = 0; i < n; ++i)
        own += static_cast<double>(u[i]) * v[i];
      return dealii::Utilities::MPI::sum(own, points->communicator());
    };
    fill_without_pattern(r, 0);
    // The start is divided by D, so that it is as rough as A is.
    for (int i = 0; i < n_points; ++i)
      for (int a = 0; a < d; ++a)
        r[d * i + a] /= inverse_diagonal[d * d * i + (d + 1) * a];
    std::fill(p.begin(), p.end(), 0.f);
    double rz = 0, alpha = 1, beta = 0;
    for (int step = 0; step < n_steps; ++step)
      {
        const double last_rz = rz;
        scale(z.data(), r.data());
        rz   = dot(r, z);
        beta = step == 0 ? 0. : rz / last_rz;
        for (int i = 0; i < n; ++i)
          p[i] = z[i] + static_cast<float>(beta) * p[i];
        apply(product.data(), p.data());
        const double pAp = dot(product, p);
        if (!(pAp > 0) || !(rz > 0))
          break;
        const double last_alpha = alpha;
        alpha                   = rz / pAp;
        diagonal.push_back(1 / alpha + beta / last_alpha);
        if (step > 0)
          beside.push_back(std::sqrt(beta) / last_alpha);
        for (int i = 0; i < n; ++i)
          r[i] -= static_cast<float>(alpha) * product[i];
      }
    largest_eigenvalue = diagonal.empty() ?
                           1. :
                           1.1 * largest_of_tridiagonal(diagonal, beside).first;
  }

  // These members are instantiated one by one, as others are in files of their
  // own.
  template AggregationLevel<3>::AggregationLevel(const unsigned int);
  template AggregationLevel<6>::AggregationLevel(const unsigned int);
  template void
  AggregationLevel<3>::build(const BlockMatrix &,
                             BlockMatrix *,
                             const std::shared_ptr<const BlockPattern> &,
                             const std::vector<PointFrame<3>> &,
                             const Coarsening &);
  template void
  AggregationLevel<6>::build(const BlockMatrix &,
                             BlockMatrix *,
                             const std::shared_ptr<const BlockPattern> &,
                             const std::vector<PointFrame<6>> &,
                             const Coarsening &);
  template void
  AggregationLevel<3>::fill_without_pattern(std::vector<float> &,
                                            const unsigned int) const;
  template void
  AggregationLevel<6>::fill_without_pattern(std::vector<float> &,
                                            const unsigned int) const;
} // namespace corotet
