// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_application_h
#define corotet_benchmarks_application_h

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "case_data.h"

namespace corotet::benchmarks
{
  /**
   * Input and output of an application y = K x, and the difference of the
   * output from that of quadrature, which shares no code with the other
   * operators, relative to the largest entry. (Benchmarks that are compared
   * with something else change @p expected.)
   */
  struct Application
  {
    explicit Application(CaseData &data)
      : x(data.problem().random_vector())
      , y(x)
      , expected(x)
      , solution(x)
      , residual(x)
    {
      data.problem().elasticity.apply_tangent_by_quadrature(expected, x);
      data.problem().clamp(expected);
    }

    /// The relative difference to @p expected, without the clamped rows: only
    /// some operators have those of a diagonal matrix.
    double
    difference(const Problem &problem) const
    {
      Vector error(y);
      error -= expected;
      problem.clamp(error);
      return error.linfty_norm() / expected.linfty_norm();
    }

    /// Updates the vectors as conjugate gradients do between applications.
    void
    update_vectors()
    {
      const double size = x * y;
      solution.add(std::isfinite(size) ? 1e-9 : 1., x);
      residual.add(-1e-9, y);
      x.add(residual.l2_norm() > 0 ? 0. : 1., residual);
    }

    Vector x;
    Vector y;
    Vector expected;
    Vector solution;
    Vector residual;
  };

  /// Adds one row of the table: @p make returns the action for an Application.
  /// It is an error if the difference exceeds @p largest_difference.
  template <typename Make>
  void
  add_application(
    CaseData          &data,
    const std::string &name,
    const Make        &make,
    const double largest_difference = std::numeric_limits<double>::infinity())
  {
    add_interleaved(data.name(name), [&data, make, largest_difference] {
      const auto     application = std::make_shared<Application>(data);
      const Measured made        = make(*application);
      made.action();
      Counters counters      = made.counters;
      counters["unknowns"]   = data.problem().n_unknowns();
      counters["difference"] = application->difference(data.problem());
      if (!(counters["difference"] <= largest_difference))
        throw std::runtime_error(
          fmt::format("the difference is {:.2g}; allowed is {:g}",
                      counters["difference"],
                      largest_difference));
      return Measured{[application, made] { made.action(); },
                      counters,
                      [application] { application->update_vectors(); }};
    });
  }

  /// The bytes that one application moves at least: the matrix, and both
  /// vectors once.
  inline double
  matrix_traffic(const double values,
                 const double indices,
                 const double rows,
                 const double unknowns)
  {
    return 8 * values + 4 * indices + 4 * rows + 16 * unknowns;
  }

  /// The operations, and the bytes that one matrix-free application moves at
  /// least: the data of cells, node indices, and both vectors once.
  inline Counters
  matrix_free_counters(const Problem &problem,
                       const double   flops_per_cell,
                       const double   bytes_per_cell)
  {
    const auto &disc = problem.discretization;
    return {{"flops", flops_per_cell * disc.n_global_cells()},
            {"bytes",
             disc.n_global_cells() *
                 (bytes_per_cell + 4. * disc.n_nodes_per_cell()) +
               16 * problem.n_unknowns()}};
  }
} // namespace corotet::benchmarks

#endif
