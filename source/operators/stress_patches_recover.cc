// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <algorithm>

#include "stress_fit.h"

// The computations for each new stress.
namespace corotet
{
  using dealii::Point;
  using dealii::SymmetricTensor;

  namespace
  {
    // The largest number of fits of a patch.
    constexpr unsigned int max_fits = 2;

    // Polynomials of fits of any degree, which use the first entries.
    using AnyPolynomials = StressPolynomials<3>;



    // Integrals of the stress times each monomial, as weighted sums over
    // samples.
    template <int degree>
    StressPolynomials<degree>
    moments(const StressFit                          &fit,
            const StressSamples                      &samples,
            const std::vector<SymmetricTensor<2, 3>> &stresses)
    {
      StressPolynomials<degree> sums = {};
      for_each_cell_of<degree>(
        fit,
        samples,
        [&](const std::size_t first,
            const auto       &points,
            const auto       &values,
            const auto       &weights) {
          std::array<std::array<double, 6>, max_samples> weighted;
          for (unsigned int q = 0; q < points.size(); ++q)
            for (unsigned int k = 0; k < 6; ++k)
              weighted[q][k] =
                weights[q] * stresses[first + q].access_raw_entry(k);
          for (unsigned int i = 0; i < sums.size(); ++i)
            for (unsigned int q = 0; q < points.size(); ++q)
              for (unsigned int k = 0; k < 6; ++k)
                sums[i][k] += values[q][i] * weighted[q][k];
        });
      return sums;
    }



    // Adds @p factor times a matrix, given row by row, times the rows of
    // @p from.
    template <std::size_t n_rows>
    void
    add_product(std::array<std::array<double, 6>, n_rows> &to,
                const double                               factor,
                const std::vector<double>                 &matrix,
                const std::array<double, 6>               *from)
    {
      const std::size_t n_columns = matrix.size() / n_rows;
      for (std::size_t i = 0; i < n_rows; ++i)
        for (std::size_t j = 0; j < n_columns; ++j)
          for (unsigned int k = 0; k < 6; ++k)
            to[i][k] += factor * matrix[i * n_columns + j] * from[j][k];
    }



    // Fits polynomials to the remainder of the stress after the first fit.
    void
    find_polynomials(const StressFit                          &fit,
                     const StressSamples                      &samples,
                     const std::vector<SymmetricTensor<2, 3>> &stresses,
                     const AnyPolynomials                     &of_first,
                     AnyPolynomials                           &result)
    {
      monomials::with_degree(fit.degree, [&](const auto degree) {
        StressPolynomials<degree> sums =
          moments<degree>(fit, samples, stresses);
        add_product(sums, -1, fit.products_with_first, of_first.data());
        StressPolynomials<degree> polynomials = {};
        add_product(polynomials, 1, fit.inverse, sums.data());
        std::copy(polynomials.begin(), polynomials.end(), result.begin());
      });
    }



    void
    add_values(const StressFit      &fit,
               const AnyPolynomials &polynomials,
               const Point<3>       &x,
               const double          factor,
               double               *values)
    {
      monomials::with_degree(fit.degree, [&](const auto degree) {
        const auto monomials = monomials_of<degree>(fit, x);
        for (unsigned int i = 0; i < monomials.size(); ++i)
          for (unsigned int k = 0; k < 6; ++k)
            values[k] += factor * monomials[i] * polynomials[i][k];
      });
    }
  } // namespace

  void
  StressPatches::recover(std::vector<SymmetricTensor<2, 3>> &at_points,
                         Vector                             &recovered) const
  {
    samples.complete(at_points);
    recovered.zero_out_ghost_values();
    for (unsigned int n = 0; n < nodes.n_owned(); ++n)
      if (wants(n))
        std::fill_n(recovered.begin() + std::size_t(6) * n, 6, 0.);
    std::array<AnyPolynomials, max_fits> polynomials;
    for (const Patch &patch : patches)
      {
        AssertIndexRange(patch.fits.size(), max_fits + 1);
        for (unsigned int f = 0; f < patch.fits.size(); ++f)
          find_polynomials(
            patch.fits[f], samples, at_points, polynomials[0], polynomials[f]);
        for (const Target &target : patch.targets)
          {
            const Point<3> x =
              discretization.node_position(nodes.copy(target.node).node);
            for (unsigned int f = 0; f < patch.fits.size(); ++f)
              add_values(patch.fits[f],
                         polynomials[f],
                         x,
                         target.weight,
                         recovered.begin() + std::size_t(6) * target.node);
          }
      }
    recovered.compress(dealii::VectorOperation::add);
    recovered.update_ghost_values();
  }
} // namespace corotet
