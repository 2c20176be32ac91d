// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/scaling.h>
#include <corotet/solvers/smoothed_aggregation.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace corotet
{
  using Column [[gnu::vector_size(16)]] = float;

  namespace
  {
    /// Of the smoother's range [-].
    constexpr double eigenvalue_ratio = 8;

    Column
    load(const float *source)
    {
      Column c;
      std::memcpy(&c, source, sizeof(c));
      return c;
    }

    void
    multiply(float *y, const float *block, const float *x)
    {
      for (int a = 0; a < 3; ++a)
        y[a] = block[a] * x[0] + block[3 + a] * x[1] + block[6 + a] * x[2];
    }

    /// The largest eigenvalue of a symmetric tridiagonal matrix with the
    /// off-diagonal entries 0, o_1, .., o_{n-1}, 0: bisection with Sturm's
    /// sequence, from Gershgorin's bound.
    double
    tridiagonal_eigenvalue(const std::vector<double> &diagonal,
                           const std::vector<double> &off_diagonal)
    {
      double lower = 0, upper = 0;
      for (unsigned int i = 0; i < diagonal.size(); ++i)
        upper =
          std::max(upper, diagonal[i] + off_diagonal[i] + off_diagonal[i + 1]);
      for (int bisection = 0; bisection < 30; ++bisection)
        {
          const double middle   = (lower + upper) / 2;
          bool         is_above = true;
          double       pivot    = 1;
          for (unsigned int i = 0; i < diagonal.size() && is_above; ++i)
            {
              pivot = middle - diagonal[i] -
                      (i == 0 ? 0. : off_diagonal[i] * off_diagonal[i] / pivot);
              is_above = pivot > 0;
            }
          (is_above ? upper : lower) = middle;
        }
      return upper;
    }
  } // namespace

  SmoothedAggregation::SmoothedAggregation(const unsigned int degree)
    : degree(degree)
    , coarse_factor(SparseCholesky::Precision::single_precision)
  {}

  void
  SmoothedAggregation::build(const BlockMatrix &A, const double *positions)
  {
    const bool is_new = pattern != A.pattern();
    if (is_new)
      {
        pattern = A.pattern();
        n_nodes = pattern->n_owned();
        for (auto *vector : {&rhs, &residual, &product})
          vector->resize(3 * n_nodes);
        for (auto *vector : {&solution, &direction})
          vector->resize(3 * pattern->exchange().n_items());
      }
    unit = unit_of(A);
    copy_matrix(A);
    if (is_new)
      set_up_pattern();
    estimate_largest_eigenvalue();
    build_coarse(A, positions);
  }

  void
  SmoothedAggregation::copy_matrix(const BlockMatrix &A)
  {
    const NodeGraph &graph = pattern->graph();
    // Columns are loaded with four entries.
    blocks.resize(9 * graph.columns.size() + 1);
    inverse_diagonal.resize(9 * n_nodes);
    is_prescribed.resize(3 * n_nodes);
    float *block = blocks.data();
    for (int node = 0; node < n_nodes; ++node)
      {
        const auto            rows    = A.rows(node);
        const int            *columns = &graph.columns[graph.starts[node]];
        const int             n = graph.starts[node + 1] - graph.starts[node];
        dealii::Tensor<2, 3>  diagonal;
        std::array<double, 3> row_sums{};
        for (int k = 0; k < n; ++k, block += 9)
          for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
              {
                const double value = rows[a][3 * k + b] / unit;
                block[3 * b + a]   = value;
                row_sums[a] += std::abs(value);
                if (columns[k] == node)
                  diagonal[a][b] = value;
              }
        const dealii::Tensor<2, 3> inverse = invert(diagonal);
        for (int a = 0; a < 3; ++a)
          {
            is_prescribed[3 * node + a] =
              row_sums[a] == std::abs(diagonal[a][a]);
            for (int b = 0; b < 3; ++b)
              inverse_diagonal[9 * node + 3 * b + a] = inverse[a][b];
          }
      }
  }

  /// Of D^-1 A: ten steps of Lanczos' method, and a margin.
  void
  SmoothedAggregation::estimate_largest_eigenvalue()
  {
    constexpr int       n_steps = 10;
    const int           n       = 3 * n_nodes;
    std::vector<double> diagonal, off_diagonal{0.};
    std::vector<float> &r = rhs, &z = residual, &p = direction;
    const auto          dot = [&](const auto &u, const auto &v) {
      double own = 0;
      for (int i = 0; i < n; ++i)
        own += static_cast<double>(u[i]) * v[i];
      return dealii::Utilities::MPI::sum(own, pattern->communicator());
    };
    // Anything that is not smooth.
    unsigned int seed =
      1 + dealii::Utilities::MPI::this_mpi_process(pattern->communicator());
    for (float &entry : r)
      {
        seed  = 1664525u * seed + 1013904223u;
        entry = (seed >> 8) * 0x1p-24f - 0.5f;
      }
    // In terms of D, so that the start is as rough as A is.
    for (int i = 0; i < n_nodes; ++i)
      for (int a = 0; a < 3; ++a)
        r[3 * i + a] /= inverse_diagonal[9 * i + 4 * a];
    std::fill(p.begin(), p.end(), 0.f);
    double rz = 0, alpha = 1, beta = 0;
    for (int step = 0; step < n_steps; ++step)
      {
        const double last_rz = rz;
        for (int i = 0; i < n_nodes; ++i)
          multiply(&z[3 * i], &inverse_diagonal[9 * i], &r[3 * i]);
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
          off_diagonal.push_back(std::sqrt(beta) / last_alpha);
        for (int i = 0; i < n; ++i)
          r[i] -= static_cast<float>(alpha) * product[i];
      }
    off_diagonal.push_back(0.);
    largest_eigenvalue = 1.1 * tridiagonal_eigenvalue(diagonal, off_diagonal);
  }

  void
  SmoothedAggregation::apply(float *y, float *x) const
  {
    const NodeGraph &graph = pattern->graph();
    pattern->exchange().update(x, 3);
    const float *block = blocks.data();
    for (int i = 0; i < n_nodes; ++i)
      {
        Column sum{};
        for (int k = graph.starts[i]; k < graph.starts[i + 1]; ++k, block += 9)
          {
            const float *v = x + 3 * graph.columns[k];
            sum += v[0] * load(block) + v[1] * load(block + 3) +
                   v[2] * load(block + 6);
          }
        for (int a = 0; a < 3; ++a)
          y[3 * i + a] = sum[a];
      }
  }

  void
  SmoothedAggregation::smooth(float       *x,
                              const float *b,
                              const bool   x_is_zero) const
  {
    const double lower      = largest_eigenvalue / eigenvalue_ratio;
    const double centre     = (largest_eigenvalue + lower) / 2;
    const double radius     = (largest_eigenvalue - lower) / 2;
    double       rho        = radius / centre;
    float        old_weight = 0, new_weight = 1 / centre;
    for (unsigned int k = 0; k < degree; ++k)
      {
        const bool is_start = k == 0 && x_is_zero;
        if (k > 0)
          {
            const double next = 1 / (2 * centre / radius - rho);
            old_weight        = next * rho;
            new_weight        = 2 * next / radius;
            rho               = next;
          }
        if (!is_start)
          apply(product.data(), x);
        for (int i = 0; i < n_nodes; ++i)
          {
            float r[3], z[3];
            for (int a = 0; a < 3; ++a)
              r[a] = b[3 * i + a] - (is_start ? 0.f : product[3 * i + a]);
            multiply(z, &inverse_diagonal[9 * i], r);
            for (int a = 0; a < 3; ++a)
              {
                const int   j    = 3 * i + a;
                const float step = new_weight * z[a] +
                                   (k == 0 ? 0.f : old_weight * direction[j]);
                direction[j] = step;
                x[j]         = is_start ? step : x[j] + step;
              }
          }
      }
  }

  /// x += P (P^T A P)^-1 P^T residual.
  void
  SmoothedAggregation::correct(float *x, const float *residual) const
  {
    const auto for_all_blocks = [&](const auto &action) {
      for (int i = 0; i < n_nodes; ++i)
        for (int k = prolongation_pattern.starts[i];
             k < prolongation_pattern.starts[i + 1];
             ++k)
          action(
            3 * i,
            &prolongation_blocks[18 * static_cast<std::size_t>(k)],
            &coarse[6 * (prolongation_pattern.columns[k] - first_aggregate)]);
    };
    std::fill(coarse.begin(), coarse.end(), 0.f);
    for_all_blocks([&](const int i, const float *p, float *c) {
      for (int m = 0; m < 6; ++m)
        c[m] += p[m] * residual[i] + p[6 + m] * residual[i + 1] +
                p[12 + m] * residual[i + 2];
    });
    coarse_factor.vmult(coarse.data(), coarse.data());
    for_all_blocks([&](const int i, const float *p, const float *c) {
      for (int a = 0; a < 3; ++a)
        for (int m = 0; m < 6; ++m)
          x[i + a] += p[6 * a + m] * c[m];
    });
  }

  void
  SmoothedAggregation::cycle(float *x, const float *b) const
  {
    smooth(x, b, true);
    apply(product.data(), x);
    for (int i = 0; i < 3 * n_nodes; ++i)
      residual[i] = b[i] - product[i];
    correct(x, residual.data());
    smooth(x, b, false);
  }

  template <typename Number>
  void
  SmoothedAggregation::vmult(Number *dst, const Number *src) const
  {
    // Numbers near 1, which no product takes out of the range of float.
    Number own_largest = 0;
    for (int i = 0; i < 3 * n_nodes; ++i)
      own_largest = std::max(own_largest, std::abs(src[i]));
    const double largest =
      dealii::Utilities::MPI::max(static_cast<double>(own_largest),
                                  pattern->communicator());
    const Number scale = largest > 0 ? largest : 1;
    const Number back  = scale / unit;
    for (int i = 0; i < 3 * n_nodes; ++i)
      rhs[i] = src[i] / scale;
    cycle(solution.data(), rhs.data());
    for (int i = 0; i < 3 * n_nodes; ++i)
      dst[i] = back * solution[i];
  }

  template void
  SmoothedAggregation::vmult(float *, const float *) const;
  template void
  SmoothedAggregation::vmult(double *, const double *) const;
} // namespace corotet
