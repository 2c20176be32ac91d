// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/chebyshev.h>
#include <corotet/solvers/largest_eigenvalue.h>

#include <cmath>
#include <vector>

namespace corotet
{
  Chebyshev::Chebyshev(const MatrixFree<float> &A,
                       const unsigned int       degree,
                       const double             range)
    : A(A)
    , degree(degree)
    , range(range)
  {
    A.nodes().initialize_vector(inverse_diagonal);
    A.nodes().initialize_vector(step);
  }

  void
  Chebyshev::update_diagonal(const FloatVector &diagonal)
  {
    const unsigned int n = inverse_diagonal.locally_owned_size();
    for (unsigned int i = 0; i < n; ++i)
      inverse_diagonal.local_element(i) = 1 / diagonal.local_element(i);
    for (const unsigned int i : A.prescribed_unknowns())
      if (i < n)
        inverse_diagonal.local_element(i) = 0;
  }

  void
  Chebyshev::estimate_eigenvalues(const FloatVector &start)
  {
    // The Lanczos method for D^{-1} A in the inner product of D.
    constexpr unsigned int n_steps = 12;
    // Ritz values come from below; what they miss is a few percent.
    constexpr double   safety = 1.1;
    const unsigned int n      = inverse_diagonal.locally_owned_size();
    FloatVector        v(inverse_diagonal), previous(v), w(v);
    for (unsigned int i = 0; i < n; ++i)
      {
        v.local_element(i) =
          start.local_element(i) * std::sqrt(inverse_diagonal.local_element(i));
        previous.local_element(i) = 0;
      }
    const auto norm = [&](const FloatVector &x) {
      double sum = 0;
      for (unsigned int i = 0; i < n; ++i)
        if (const double inverse = inverse_diagonal.local_element(i);
            inverse != 0)
          sum += x.local_element(i) * x.local_element(i) / inverse;
      return std::sqrt(
        dealii::Utilities::MPI::sum(sum, A.nodes().communicator()));
    };

    std::vector<double> alphas, betas;
    double              beta = norm(v);
    v *= 1 / beta;
    beta = 0;
    for (unsigned int k = 0; k < n_steps; ++k)
      {
        A.vmult(w, v);
        double alpha = 0;
        for (unsigned int i = 0; i < n; ++i)
          alpha += double(v.local_element(i)) * w.local_element(i);
        alpha = dealii::Utilities::MPI::sum(alpha, A.nodes().communicator());
        for (unsigned int i = 0; i < n; ++i)
          w.local_element(i) =
            inverse_diagonal.local_element(i) * w.local_element(i) -
            float(alpha) * v.local_element(i) -
            float(beta) * previous.local_element(i);
        alphas.push_back(alpha);
        beta = norm(w);
        // The space is exhausted: a mesh with few free unknowns.
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
    for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
      {
        const float d =
          inverse_diagonal.local_element(i) * b.local_element(i) / centre;
        step.local_element(i) = d;
        x.local_element(i)    = d;
      }
    remaining_steps(x, b);
  }

  void
  Chebyshev::smooth(FloatVector &x, const FloatVector &b) const
  {
    const float centre = max_eigenvalue * (1 + 1 / range) / 2;
    A.chebyshev_step(x, step, b, inverse_diagonal, 0, 1 / centre);
    remaining_steps(x, b);
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
        A.chebyshev_step(
          x, step, b, inverse_diagonal, next * rho, 2 * next / radius);
        rho = next;
      }
  }
} // namespace corotet
