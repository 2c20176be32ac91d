// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/solvers/preconditioners.h>

#include <deal.II/base/mpi.h>

#include "static_solve.h"
#include <Eigen/CholmodSupport>

namespace corotet::benchmarks
{
  namespace
  {
    Counters
    solve_by_cholmod(CaseData &data)
    {
      const Vector  b    = data.problem().weight();
      const CsrView view = data.compressed_rows().view();
      // The compressed rows of a symmetric matrix are its compressed columns.
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
    const auto add = [&data](const std::string &name,
                             const std::string &type,
                             const std::string &parameters) {
      // The assembled matrix is made before, for preconditioners that need it.
      const bool assemble = type != "p-multigrid" && type != "jacobi";
      add_long(
        data.name("solve/" + name),
        [&data, type, parameters, assemble] {
          if (assemble || data.which().degree == 1)
            data.matrix();
          return solve(data,
                       data.effective(),
                       *make_preconditioner(type, parameters));
        },
        type == "p-multigrid" ? 3 : 1);
    };
    for (const auto &candidate : preconditioners())
      add(candidate.name, candidate.name, "");
    for (const std::string coarse : {"direct", "aggregation"})
      add("p-multigrid-" + coarse,
          "p-multigrid",
          "set Coarse solver = " + coarse);
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
    for (const auto &candidate : preconditioners())
      if (candidate.name != "direct")
        add_long(data.name("memory/" + candidate.name),
                 [&data, sum, type = candidate.name] {
                   Counters     result;
                   const double at_start = data.problem().memory_at_start;
                   result["discretization_bytes"] =
                     sum(present_memory()) - at_start;
                   const Vector b = data.problem().weight();
                   Vector       x(b);
                   const auto   P = make_preconditioner(type);
                   P->build(data.effective(), data.problem().state_of_solves());
                   // Some iterations use all the memory that a solve needs.
                   result["seconds"]    = seconds([&] {
                     conjugate_gradients(data.effective(), x, b, *P, 0.1);
                   });
                   result["unknowns"]   = data.problem().n_unknowns();
                   result["peak_bytes"] = sum(peak_memory()) - at_start;
                   result["bytes_per_unknown"] =
                     result["peak_bytes"] / result["unknowns"];
                   return result;
                 });
  }
} // namespace corotet::benchmarks
