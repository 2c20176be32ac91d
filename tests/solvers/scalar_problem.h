// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_solvers_scalar_problem_h
#define corotet_tests_solvers_scalar_problem_h

#include <corotet/base/exceptions.h>
#include <corotet/solvers/newton.h>

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace corotet::tests
{
  // The problem f(x) = 0 with a given approximation of f'(x).
  class Scalar : public NewtonProblem
  {
  public:
    Scalar(std::function<double(double)> f,
           std::function<double(double)> slope,
           const double                  start)
      : f(std::move(f))
      , slope(std::move(slope))
      , x(start)
    {}

    Norm
    residual(Vector &r) override
    {
      r = -f(x);
      return {std::abs(f(x)), 1.};
    }

    unsigned int
    solve_linearized(Vector       &dx,
                     const Vector &r,
                     const double  tolerance) override
    {
      tolerances.push_back(tolerance);
      dx = r;
      dx *= 1 / slope(x);
      return 1;
    }

    Norm
    add(const double factor, const Vector &dx) override
    {
      x += factor * dx.local_element(0);
      return {std::abs(factor * dx.local_element(0)), std::abs(x)};
    }

    void
    keep() override
    {
      kept = x;
    }

    void
    restore() override
    {
      x = kept;
      ++n_restored;
    }

    bool
    has_energy() const override
    {
      return with_energy;
    }

    std::function<double(double)> f, slope;
    double                        x;
    double                        kept        = 0;
    unsigned int                  n_restored  = 0;
    bool                          with_energy = false;
    // The tolerances of all linear solves.
    std::vector<double> tolerances;
  };

  inline NewtonReport
  solve(Scalar &problem, const double tolerance = 1e-12)
  {
    NewtonParameters parameters;
    parameters.residual_tolerance  = tolerance;
    parameters.increment_tolerance = tolerance;
    NewtonReport report;
    Newton(parameters).solve(problem, Vector(1), report);
    return report;
  }

  inline std::string
  failure(Scalar &problem)
  {
    try
      {
        solve(problem);
      }
    catch (const ComputationError &error)
      {
        return error.what();
      }
    return "it converged";
  }
} // namespace corotet::tests

#endif
