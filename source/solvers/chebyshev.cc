// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/chebyshev.h>
#include <corotet/solvers/largest_eigenvalue.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace corotet
{
  Chebyshev::Chebyshev(const CellwiseOperator<float> &A,
                       const unsigned int             degree,
                       const double                   range)
    : A(A)
    , degree(degree)
    , range(range)
  {
    A.nodes().initialize_vector(inverse_diagonal);
    A.nodes().initialize_vector(step);
  }

  void
  Chebyshev::update_diagonal(const FloatVector            &diagonal,
                             const SurfaceOperator<float> *surface)
  {
    const unsigned int n = inverse_diagonal.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      inverse_diagonal.local_element(i) = 1 / diagonal.local_element(i);
    if (surface != nullptr)
      for (unsigned int k = 0; k < surface->owned_nodes().size(); ++k)
        for (unsigned int a = 0; a < 3; ++a)
          {
            const unsigned int i = 3 * surface->owned_nodes()[k] + a;
            inverse_diagonal.local_element(i) =
              1 /
              (diagonal.local_element(i) + surface->diagonal_blocks()[k][a][a]);
          }
    for (const unsigned int i : A.prescribed_unknowns())
      if (i < n)
        inverse_diagonal.local_element(i) = 0;
    blocks.clear();
    if (surface != nullptr)
      find_blocks(diagonal, *surface);
  }

  void
  Chebyshev::find_blocks(const FloatVector            &diagonal,
                         const SurfaceOperator<float> &surface)
  {
    // Couplings below this part of the diagonal are ignored.
    constexpr double weak  = 0.1;
    const auto      &nodes = surface.owned_nodes();
    for (unsigned int k = 0; k < nodes.size(); ++k)
      {
        NodeBlock   block{nodes[k], {}, {}};
        const auto &S          = surface.diagonal_blocks()[k];
        bool        is_coupled = false;
        // In double precision: single precision would lose the rest of A beside
        // stiff springs, which have no stiffness along the surface.
        const auto diagonal_entry = [&](const unsigned int a) {
          return diagonal.local_element(3 * nodes[k] + a) + S[a][a];
        };
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            {
              const unsigned int i = 3 * nodes[k] + a, j = 3 * nodes[k] + b;
              if (inverse_diagonal.local_element(i) == 0 ||
                  inverse_diagonal.local_element(j) == 0)
                block.D[a][b] = a == b ? 1. : 0.;
              else if (a == b)
                block.D[a][a] = diagonal_entry(a);
              else
                {
                  block.D[a][b] = S[a][b];
                  is_coupled =
                    is_coupled ||
                    std::abs(S[a][b]) > weak * std::sqrt(diagonal_entry(a)) *
                                          std::sqrt(diagonal_entry(b));
                }
            }
        if (!is_coupled)
          continue;
        block.inverse = invert(block.D);
        for (unsigned int a = 0; a < 3; ++a)
          if (inverse_diagonal.local_element(3 * nodes[k] + a) == 0)
            block.D[a][a] = block.inverse[a][a] = 0;
        blocks.push_back(block);
      }
    if (!blocks.empty() && residual.size() == 0)
      for (FloatVector *vector : {&residual, &scaled_residual})
        A.nodes().initialize_vector(*vector);
  }

  void
  Chebyshev::scale(FloatVector &y, const FloatVector &x) const
  {
    for (unsigned int i = 0; i < y.locally_owned_size(); ++i)
      y.local_element(i) =
        inverse_diagonal.local_element(i) * x.local_element(i);
    for (const NodeBlock &block : blocks)
      for (unsigned int a = 0; a < 3; ++a)
        {
          double sum = 0;
          for (unsigned int b = 0; b < 3; ++b)
            sum += block.inverse[a][b] * x.local_element(3 * block.node + b);
          y.local_element(3 * block.node + a) = sum;
        }
  }

  double
  Chebyshev::norm(const FloatVector &x) const
  {
    // Where the inverse is zero, x is zero. Eight partial sums are taken at
    // once.
    constexpr float        smallest = std::numeric_limits<float>::min();
    constexpr unsigned int n_sums   = 8;
    const float *const     inverse  = inverse_diagonal.begin();
    const float *const     values   = x.begin();
    const auto             square   = [&](const unsigned int i) {
      return static_cast<double>(values[i]) * values[i] /
             std::max(inverse[i], smallest);
    };
    double     sum = 0;
    const auto add = [&](unsigned int i, const unsigned int end) {
      double sums[n_sums] = {};
      for (; i + n_sums <= end; i += n_sums)
        for (unsigned int k = 0; k < n_sums; ++k)
          sums[k] += square(i + k);
      for (; i < end; ++i)
        sum += square(i);
      for (const double part : sums)
        sum += part;
    };
    // The sum covers the entries between the blocks, which are in ascending
    // order.
    unsigned int next = 0;
    for (const NodeBlock &block : blocks)
      {
        add(next, 3 * block.node);
        next = 3 * block.node + 3;
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; b < 3; ++b)
            sum += block.D[a][b] * x.local_element(3 * block.node + a) *
                   x.local_element(3 * block.node + b);
      }
    add(next, x.locally_owned_size());
    return std::sqrt(
      dealii::Utilities::MPI::sum(sum, A.nodes().communicator()));
  }

  void
  Chebyshev::estimate_eigenvalues(const FloatVector &start)
  {
    // This is the Lanczos method for D^{-1} A in the inner product of D.
    constexpr unsigned int n_steps = 12;
    // Ritz values approach from below and miss a few percent.
    constexpr double   safety = 1.1;
    const unsigned int n      = inverse_diagonal.locally_owned_size();
    FloatVector        v(inverse_diagonal), previous(v), w(v);
    for (unsigned int i = 0; i < n; ++i)
      {
        v.local_element(i) =
          start.local_element(i) * std::sqrt(inverse_diagonal.local_element(i));
        previous.local_element(i) = 0;
      }
    std::vector<double> alphas, betas;
    double              beta = norm(v);
    // There is no free unknown.
    if (beta == 0)
      {
        max_eigenvalue = 1;
        return;
      }
    v *= 1 / beta;
    beta = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        A.vmult(w, v);
        double alpha = 0;
        for (unsigned int i = 0; i < n; ++i)
          alpha += double(v.local_element(i)) * w.local_element(i);
        alpha = dealii::Utilities::MPI::sum(alpha, A.nodes().communicator());
        if (blocks.empty())
          for (unsigned int i = 0; i < n; ++i)
            w.local_element(i) =
              inverse_diagonal.local_element(i) * w.local_element(i) -
              float(alpha) * v.local_element(i) -
              float(beta) * previous.local_element(i);
        else
          {
            scale(scaled_residual, w);
            for (unsigned int i = 0; i < n; ++i)
              w.local_element(i) = scaled_residual.local_element(i) -
                                   float(alpha) * v.local_element(i) -
                                   float(beta) * previous.local_element(i);
          }
        alphas.push_back(alpha);
        beta = norm(w);
        // The Krylov space is exhausted: a mesh with few free unknowns.
        if (!(beta > 1e-5 * alpha))
          break;
        betas.push_back(beta);
        w *= 1 / beta;
        previous.swap(v);
        v.swap(w);
      }
    max_eigenvalue = safety * largest_of_tridiagonal(alphas, betas).first;
  }

  void
  Chebyshev::smooth_from_zero(FloatVector &x, const FloatVector &b) const
  {
    // The first step needs no A.
    const float centre = max_eigenvalue * (1 + 1 / range) / 2;
    if (blocks.empty())
      for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
        {
          const float d =
            inverse_diagonal.local_element(i) * b.local_element(i) / centre;
          step.local_element(i) = d;
          x.local_element(i)    = d;
        }
    else
      {
        scale(step, b);
        for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
          {
            step.local_element(i) /= centre;
            x.local_element(i) = step.local_element(i);
          }
      }
    remaining_steps(x, b);
  }

  void
  Chebyshev::smooth(FloatVector &x, const FloatVector &b) const
  {
    const float centre = max_eigenvalue * (1 + 1 / range) / 2;
    make_step(x, b, 0, 1 / centre);
    remaining_steps(x, b);
  }

  void
  Chebyshev::make_step(FloatVector       &x,
                       const FloatVector &b,
                       const float        beta,
                       const float        alpha) const
  {
    if (blocks.empty())
      {
        A.chebyshev_step(x, step, b, inverse_diagonal, beta, alpha);
        return;
      }
    A.residual(residual, b, x);
    scale(scaled_residual, residual);
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      {
        step.local_element(i) = beta * step.local_element(i) +
                                alpha * scaled_residual.local_element(i);
        x.local_element(i) += step.local_element(i);
      }
  }

  void
  Chebyshev::remaining_steps(FloatVector &x, const FloatVector &b) const
  {
    const double centre = max_eigenvalue * (1 + 1 / range) / 2;
    const double radius = max_eigenvalue * (1 - 1 / range) / 2;
    const double sigma  = centre / radius;
    double       rho    = 1 / sigma;
    for (unsigned int k = 1; k < degree; ++k)
      {
        const double next = 1 / (2 * sigma - rho);
        make_step(x, b, next * rho, 2 * next / radius);
        rho = next;
      }
  }
} // namespace corotet
