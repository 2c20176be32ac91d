// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/aggregation_level.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>

namespace corotet
{
  namespace
  {
    /// Ratio of the eigenvalues between which the smoother damps [-].
    constexpr double eigenvalue_ratio = 8;

    using FourFloats [[gnu::vector_size(16)]]  = float;
    using EightFloats [[gnu::vector_size(32)]] = float;

    /// A register for a column of a block; its other numbers are ignored.
    template <int d>
    using Column = std::conditional_t<d == 3, FourFloats, EightFloats>;

    template <int d>
    Column<d>
    load(const float *source)
    {
      Column<d> c;
      std::memcpy(&c, source, sizeof(c));
      return c;
    }

    template <int d>
    void
    multiply(float *y, const float *block, const float *x)
    {
      for (int a = 0; a < d; ++a)
        {
          y[a] = block[a] * x[0];
          for (int b = 1; b < d; ++b)
            y[a] += block[d * b + a] * x[b];
        }
    }
  } // namespace

  template <int d>
  void
  AggregationLevel<d>::apply(float *y, float *x) const
  {
    const NodeGraph &graph = points->graph();
    points->exchange().update(x, d);
    const float *block = blocks.data();
    for (int i = 0; i < n_points; ++i)
      {
        Column<d> sum{};
        for (int k = graph.starts[i]; k < graph.starts[i + 1];
             ++k, block += offset(d))
          {
            const float *v = x + offset(graph.columns[k]);
            Column<d>    part{};
            for (int b = 0; b < d; ++b)
              part += v[b] * load<d>(block + offset(b));
            sum += part;
          }
        for (int a = 0; a < d; ++a)
          y[d * i + a] = sum[a];
      }
  }

  /// z = D^-1 r.
  template <int d>
  void
  AggregationLevel<d>::scale(float *z, const float *r) const
  {
    if (!has_aggregate_blocks)
      {
        for (int i = 0; i < n_points; ++i)
          multiply<d>(&z[offset(i)],
                      &inverse_diagonal[d * offset(i)],
                      &r[offset(i)]);
        return;
      }
    float *const sum = block_product.data();
    for (int g = 0; g < points_of_aggregates.n_rows(); ++g)
      {
        const int    begin   = points_of_aggregates.starts[g];
        const int    n       = points_of_aggregates.starts[g + 1] - begin;
        const int   *own     = &points_of_aggregates.columns[begin];
        const float *inverse = &inverse_aggregates[starts_of_inverses[g]];
        std::fill_n(sum, d * n, 0.f);
        for (int i = 0; i < n; ++i)
          for (int a = 0; a < d; ++a, inverse += offset(n))
            for (int j = 0; j < d * n; ++j)
              sum[j] += inverse[j] * r[d * own[i] + a];
        for (int i = 0; i < n; ++i)
          std::copy_n(sum + offset(i), d, z + offset(own[i]));
      }
  }

  template <int d>
  void
  AggregationLevel<d>::smooth(const bool x_is_zero) const
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
          apply(product.data(), x.data());
        const auto step = [&](const int j, const float z) {
          const float s =
            new_weight * z + (k == 0 ? 0.f : old_weight * direction[j]);
          direction[j] = s;
          x[j]         = is_start ? s : x[j] + s;
        };
        if (has_aggregate_blocks)
          {
            for (int j = 0; j < d * n_points; ++j)
              residual[j] = rhs[j] - (is_start ? 0.f : product[j]);
            scale(scaled.data(), residual.data());
            for (int j = 0; j < d * n_points; ++j)
              step(j, scaled[j]);
            continue;
          }
        for (int i = 0; i < n_points; ++i)
          {
            float r[d], z[d];
            for (int a = 0; a < d; ++a)
              r[a] = rhs[d * i + a] - (is_start ? 0.f : product[d * i + a]);
            multiply<d>(z, &inverse_diagonal[d * offset(i)], r);
            for (int a = 0; a < d; ++a)
              step(d * i + a, z[a]);
          }
      }
  }

  /// Calls action(first unknown of the point, block, first unknown of the
  /// aggregate) for owned points.
  template <int d>
  template <typename Action>
  void
  AggregationLevel<d>::for_each_prolongation_block(const Action &action) const
  {
    for (int i = 0; i < n_points; ++i)
      for (int k = prolongation_pattern.starts[i];
           k < prolongation_pattern.starts[i + 1];
           ++k)
        action(d * i,
               prolongation[k].data()->data(),
               6 * prolongation_columns[k]);
  }

  template <int d>
  void
  AggregationLevel<d>::restrict_residual(float *coarse) const
  {
    apply(product.data(), x.data());
    for (int i = 0; i < d * n_points; ++i)
      residual[i] = rhs[i] - product[i];
    float *const values = coarse_values.data();
    std::fill_n(values, coarse_values.size(), 0.f);
    for_each_prolongation_block([&](const int i, const float *p, const int g) {
      for (int m = 0; m < 6; ++m)
        {
          float sum = p[m] * residual[i];
          for (int a = 1; a < d; ++a)
            sum += p[6 * a + m] * residual[i + a];
          values[g + m] += sum;
        }
    });
    coarse_exchange.add(values, 6);
    std::copy_n(values, 6 * points_of_aggregates.n_rows(), coarse);
  }

  template <int d>
  void
  AggregationLevel<d>::prolongate_add(const float *coarse) const
  {
    float *const values = coarse_values.data();
    std::copy_n(coarse, 6 * points_of_aggregates.n_rows(), values);
    coarse_exchange.update(values, 6);
    for_each_prolongation_block([&](const int i, const float *p, const int g) {
      for (int a = 0; a < d; ++a)
        for (int m = 0; m < 6; ++m)
          x[i + a] += p[6 * a + m] * values[g + m];
    });
  }

  // These members are instantiated one by one, as others are in files of their
  // own.
  template void
  AggregationLevel<3>::apply(float *, float *) const;
  template void
  AggregationLevel<6>::apply(float *, float *) const;
  template void
  AggregationLevel<3>::scale(float *, const float *) const;
  template void
  AggregationLevel<6>::scale(float *, const float *) const;
  template void
  AggregationLevel<3>::smooth(const bool) const;
  template void
  AggregationLevel<6>::smooth(const bool) const;
  template void
  AggregationLevel<3>::restrict_residual(float *) const;
  template void
  AggregationLevel<6>::restrict_residual(float *) const;
  template void
  AggregationLevel<3>::prolongate_add(const float *) const;
  template void
  AggregationLevel<6>::prolongate_add(const float *) const;
} // namespace corotet
