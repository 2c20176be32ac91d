// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/preconditioners.h>

#include <deal.II/base/mpi.h>

#include "case_data.h"
#include <Eigen/CholmodSupport>

namespace corotet::benchmarks
{
  namespace
  {
    constexpr double static_tolerance = 1e-8;

    /// |b - A x| / |b|, by the assembled matrix.
    double
    residual(CaseData &data, const Vector &x, const Vector &b)
    {
      Vector r(b);
      data.assembled().vmult(r, x);
      r -= b;
      return r.l2_norm() / b.l2_norm();
    }

    /// By conjugate gradients with @p A, whose preconditioner is made from the
    /// effective operator.
    template <typename Operator>
    Counters
    solve(CaseData &data, const Operator &A, Preconditioner &P)
    {
      const Vector b = data.problem().weight();
      Vector       x(b);
      Counters     result;
      result["unknowns"] = data.problem().n_unknowns();
      result["setup_s"]  = seconds([&] {
        P.build(data.assembled(),
                data.problem().discretization.node_positions());
      });
      result["solve_s"]  = seconds([&] {
        result["cg_iterations"] =
          conjugate_gradients(A, x, b, P, static_tolerance);
      });
      result["residual"] = residual(data, x, b);
      result["seconds"]  = result["setup_s"] + result["solve_s"];
      return result;
    }

    Counters
    solve_by_cholmod(CaseData &data)
    {
      const Vector  b    = data.problem().weight();
      const CsrView view = csr_view(data.assembled().matrix());
      // A symmetric matrix in compressed rows is one in compressed columns.
      using Columns = Eigen::SparseMatrix<double>;
      const Eigen::Map<const Columns>                    matrix(view.rows(),
                                             view.cols(),
                                             view.nonZeros(),
                                             view.outerIndexPtr(),
                                             view.innerIndexPtr(),
                                             view.valuePtr());
      Vector                                             x(b);
      Counters                                           result;
      Eigen::CholmodSupernodalLLT<Columns, Eigen::Lower> factors;
      result["unknowns"] = data.problem().n_unknowns();
      result["setup_s"]  = seconds([&] { factors.compute(matrix); });
      result["solve_s"]  = seconds([&] {
        Eigen::Map<Eigen::VectorXd>(x.begin(), view.rows()) = factors.solve(
          Eigen::Map<const Eigen::VectorXd>(b.begin(), view.rows()));
      });
      result["residual"] = residual(data, x, b);
      result["seconds"]  = result["setup_s"] + result["solve_s"];
      return result;
    }
  } // namespace

  std::unique_ptr<Preconditioner>
  make_preconditioner(const std::string &type, const std::string &parameters)
  {
    for (const auto &candidate : preconditioners())
      if (candidate.name == type)
        {
          auto                     result = candidate.make();
          dealii::ParameterHandler prm;
          result->declare_parameters(prm);
          prm.parse_input_from_string(parameters);
          return result;
        }
    AssertThrow(false, dealii::ExcMessage("No preconditioner " + type));
    return nullptr;
  }

  void
  add_solvers(CaseData &data)
  {
    for (const auto &candidate : preconditioners())
      add_long(
        data.name("solve/" + candidate.name), [&data, type = candidate.name] {
          return solve(data, data.assembled(), *make_preconditioner(type));
        });
    // The usual way, whatever the effective operator does.
    add_long(data.name("solve/cg_ml"), [&data] {
      return solve(data,
                   data.assembled().matrix(),
                   *make_preconditioner("amg"));
    });
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
      add_long(data.name("solve/cholmod"),
               [&data] { return solve_by_cholmod(data); });
  }

  void
  add_memory(CaseData &data)
  {
    const auto sum = [](const double value) {
      return dealii::Utilities::MPI::sum(value, MPI_COMM_WORLD);
    };
    const double at_start = sum(present_memory());
    for (const auto &candidate : preconditioners())
      if (candidate.name != "direct")
        add_long(data.name("memory/" + candidate.name),
                 [&data, sum, at_start, type = candidate.name] {
                   Counters result;
                   result["discretization_bytes"] =
                     (data.problem(), sum(present_memory()) - at_start);
                   const Vector b = data.problem().weight();
                   Vector       x(b);
                   const auto   P = make_preconditioner(type);
                   P->build(data.assembled(),
                            data.problem().discretization.node_positions());
                   // Some iterations touch all that a solve needs.
                   result["seconds"]    = seconds([&] {
                     conjugate_gradients(data.assembled(), x, b, *P, 0.1);
                   });
                   result["unknowns"]   = data.problem().n_unknowns();
                   result["peak_bytes"] = sum(peak_memory()) - at_start;
                   result["bytes_per_unknown"] =
                     result["peak_bytes"] / result["unknowns"];
                   return result;
                 });
  }
} // namespace corotet::benchmarks
