// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <deal.II/base/mpi.h>

#include "case_data.h"

namespace corotet::benchmarks
{
  namespace
  {
    /// Bytes that one application moves at least: the matrix, and both vectors
    /// once.
    double
    matrix_traffic(const double values,
                   const double indices,
                   const double rows,
                   const double unknowns)
    {
      return 8 * values + 4 * indices + 4 * rows + 16 * unknowns;
    }

    /**
     * Input and output of an application, and how far the output is from that
     * of the assembled matrix, relative to its largest entry.
     */
    struct Application
    {
      explicit Application(CaseData &data)
        : x(data.problem().random_vector())
        , y(data.problem().vector())
        , expected(y)
      {
        data.assembled().vmult(expected, x);
      }

      double
      difference() const
      {
        Vector error(y);
        error -= expected;
        return error.linfty_norm() / expected.linfty_norm();
      }

      Vector x;
      Vector y;
      Vector expected;
    };

    /// One row of the table: @p make returns a function of an Application.
    template <typename Make>
    void
    add_application(CaseData &data, const std::string &name, const Make &make)
    {
      add_short(data.name(name), [&data, make] {
        const auto     application = std::make_shared<Application>(data);
        const Measured made        = make(*application);
        made.action();
        Counters counters      = made.counters;
        counters["unknowns"]   = data.problem().n_unknowns();
        counters["difference"] = application->difference();
        return Measured{[application, made] { made.action(); }, counters};
      });
    }

    void
    add_matrix_formats(CaseData &data)
    {
      const auto flops = [&data] {
        return 2. * data.assembly_figures().at("nonzeros");
      };
      add_application(data, "epetra", [&data, flops](Application &a) {
        const auto  &matrix = data.assembled().matrix();
        const double n      = data.problem().n_unknowns();
        return Measured{[&] { matrix.vmult(a.y, a.x); },
                        {{"flops", flops()},
                         {"bytes",
                          matrix_traffic(flops() / 2, flops() / 2, n, n)}}};
      });
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        return;
      add_application(data, "eigen", [&data, flops](Application &a) {
        const CsrView view = csr_view(data.assembled().matrix());
        const double  n    = view.rows();
        return Measured{
          [&a, view] {
            Eigen::Map<const Eigen::VectorXd> x(a.x.begin(), view.cols());
            Eigen::Map<Eigen::VectorXd>       y(a.y.begin(), view.rows());
            y.noalias() = view * x;
          },
          {{"flops", flops()},
           {"bytes", matrix_traffic(flops() / 2, flops() / 2, n, n)}}};
      });
      add_application(data, "block_csr", [&data, flops](Application &a) {
        const BlockMatrix &blocks = data.blocks();
        const double       n      = data.problem().n_unknowns();
        return Measured{
          [&] { blocks.vmult(a.y.begin(), a.x.begin()); },
          {{"flops", flops()},
           {"bytes",
            matrix_traffic(flops() / 2, blocks.n_blocks(), 2 * n / 3, n)}}};
      });
    }
  } // namespace

  void
  add_operators(CaseData &data)
  {
    add_long(data.name("assembly"),
             [&data] { return data.assembly_figures(); });
    add_matrix_formats(data);
  }
} // namespace corotet::benchmarks
