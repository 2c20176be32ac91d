// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/solvers/largest_eigenvalue.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  std::pair<double, double>
  largest_of_tridiagonal(const std::vector<double> &diagonal,
                         const std::vector<double> &beside)
  {
    // LAPACK's tolerances are absolute, so the matrix is scaled to size one.
    double size = 0;
    for (const auto *entries : {&diagonal, &beside})
      for (const double entry : *entries)
        {
          if (!std::isfinite(entry))
            return {std::numeric_limits<double>::quiet_NaN(), 1.};
          size = std::max(size, std::abs(entry));
        }
    if (size == 0)
      return {0., 1.};

    const unsigned int               n = diagonal.size();
    dealii::LAPACKFullMatrix<double> T(n);
    double                           norm = 0;
    for (unsigned int k = 0; k < n; ++k)
      {
        T(k, k) = diagonal[k] / size;
        norm += std::abs(T(k, k));
        if (k + 1 < n)
          {
            T(k, k + 1) = T(k + 1, k) = beside[k] / size;
            norm += 2 * std::abs(T(k, k + 1));
          }
      }
    dealii::Vector<double>     eigenvalues;
    dealii::FullMatrix<double> eigenvectors;
    // The eigenvalues are computed to round-off: a larger tolerance of the
    // bisection would make the result depend on any rounding of T. The norm
    // bounds them; the interval excludes its lower end.
    T.compute_eigenvalues_symmetric(
      -1.1 * norm, 1.1 * norm, 1e-14 * norm, eigenvalues, eigenvectors);
    AssertThrow(eigenvalues.size() == n, dealii::ExcInternalError());
    // The eigenvalues are in ascending order.
    return {size * eigenvalues[n - 1], std::abs(eigenvectors(n - 1, n - 1))};
  }

  double
  largest_eigenvalue(const SymmetricPencil &pencil,
                     Vector                &start,
                     const double           tolerance)
  {
    // Some 30 steps are enough for an accuracy of a hundredth.
    constexpr unsigned int max_steps = 300;
    // The small eigenvalue problem is not solved after every step.
    constexpr unsigned int steps_between_checks = 4;
    // Where the start has little of the largest eigenvalue's direction, another
    // eigenvalue settles first; two more checks bring the largest one to light.
    constexpr unsigned int checks_to_settle = 3;
    unsigned int           n_settled        = 0;

    Vector    &v = start;
    Vector     previous(v), w(v), z(v);
    const auto scale = [&](Vector &x) {
      pencil.mass(z, x);
      const double norm = std::sqrt(std::max(x * z, 0.));
      if (!std::isfinite(norm))
        throw ComputationError(
          "the largest eigenvalue: the matrices are not finite");
      if (norm > 0)
        x *= 1 / norm;
      return norm;
    };
    if (scale(v) == 0)
      return 0;
    previous = 0;

    std::vector<double> alphas, betas;
    double              beta = 0;
    for (unsigned int k = 0; k < max_steps; ++k)
      {
        pencil.stiffness(z, v);
        const double alpha = v * z;
        alphas.push_back(alpha);
        pencil.inverse_mass(w, z);
        w.add(-alpha, v, -beta, previous);
        beta = scale(w);
        // The Krylov space is exhausted: the mesh has few free unknowns.
        const bool is_exhausted = beta <= 1e-10 * std::abs(alpha);
        if (is_exhausted || (k + 1) % steps_between_checks == 0)
          {
            const auto [theta, last] = largest_of_tridiagonal(alphas, betas);
            n_settled = beta * last <= tolerance * theta ? n_settled + 1 : 0;
            if (is_exhausted || n_settled == checks_to_settle)
              return theta + beta * last;
          }
        betas.push_back(beta);
        previous.swap(v);
        v.swap(w);
      }
    throw ComputationError("the largest eigenvalue did not converge");
  }
} // namespace corotet
