// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What the log says about slow linear solves.

#include <corotet/discretization/cell_proportions.h>
#include <corotet/simulation/implicit_solver.h>

#include <fmt/format.h>

#include <algorithm>

namespace corotet
{
  void
  ImplicitSolver::report_linear_solver(const unsigned int n_iterations)
  {
    const std::string news = linear_solver.take_news();
    if (!news.empty())
      log.line(news);
    constexpr unsigned int slow = 100, many = 1000;
    if (n_iterations <= slow || slow_iterations > many)
      return;
    slow_iterations += std::min(n_iterations, many + 1);
    if (slow_iterations <= many)
      return;
    constexpr double incompressible = 0.45;
    std::string remedies = "more cells across thin parts or fewer along them";
    if (body.elasticity.largest_poissons_ratio() > incompressible)
      remedies += ", a Poisson's ratio less close to 1/2";
    if (linear_solver.type() != "automatic" && linear_solver.type() != "direct")
      remedies = "'Linear solver/Type = automatic', " + remedies;
    log.line(fmt::format("linear solves take more than {} iterations: {}; what "
                         "would help: {}",
                         slow,
                         cell_proportions(body.discretization).text(),
                         remedies));
  }
} // namespace corotet
