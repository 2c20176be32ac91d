// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/with_degree.h>

#include <deal.II/base/mpi.h>

#include "application.h"
#include "flops.h"
#include "single_precision.h"

namespace corotet::benchmarks
{
  namespace
  {
    void
    add_matrix_formats(CaseData &data)
    {
      const auto flops = [&data] {
        return 2. * data.assembly_figures().at("nonzeros");
      };
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        return;
      add_application(data, "eigen", [&data, flops](Application &a) {
        const CsrView view = data.compressed_rows().view();
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
        const RegisterBlocks &blocks = data.blocks();
        const double          n      = data.problem().n_unknowns();
        return Measured{
          [&] { blocks.vmult(a.y.begin(), a.x.begin()); },
          {{"flops", flops()},
           {"bytes",
            matrix_traffic(flops() / 2, blocks.n_blocks(), 2 * n / 3, n)}}};
      });
    }

    /// Operations per cell of the factored kernel and of the quadrature.
    struct Flops
    {
      double stiffness  = 0;
      double with_mass  = 0;
      double quadrature = 0;
    };

    Flops
    flops_per_cell(const Problem &problem)
    {
      Flops result;
      with_degree(problem.discretization.degree(), [&](const auto p) {
        constexpr int degree = decltype(p)::value;
        result.stiffness     = factored_flops<degree, true, false>();
        result.with_mass     = factored_flops<degree, true, true>();
        result.quadrature    = quadrature_flops<degree>(
          problem.reference.stiffness_rule.weights.size());
      });
      return result;
    }

    void
    add_matrix_free(CaseData &data)
    {
      add_application(data, "matrix_free", [&data](Application &a) {
        const EffectiveOperator &A = data.effective();
        return Measured{
          [&A, &a] { A.vmult(a.y, a.x); },
          matrix_free_counters(data.problem(),
                               flops_per_cell(data.problem()).stiffness,
                               80)};
      });
      add_application(data, "matrix_free_mass", [&data](Application &a) {
        const Problem &p  = data.problem();
        const double   dt = first_period() / 100;
        const auto     A  = std::make_shared<EffectiveOperator>(
          p.discretization, p.elasticity, p.mass, p.motion.is_prescribed());
        A->update(1., 4 / (dt * dt));
        Vector inertia(a.x);
        p.mass.apply(inertia, a.x);
        p.clamp(inertia);
        a.expected.add(4 / (dt * dt), inertia);
        return Measured{[A, &a] { A->vmult(a.y, a.x); },
                        matrix_free_counters(p,
                                             flops_per_cell(p).with_mass,
                                             88)};
      });
      add_application(data, "quadrature", [&data](Application &a) {
        const Problem &p = data.problem();
        data.effective().vmult(a.expected, a.x);
        return Measured{
          [&p, &a] { p.elasticity.apply_tangent_by_quadrature(a.y, a.x); },
          matrix_free_counters(p, flops_per_cell(p).quadrature, 168)};
      });
    }

    /// Adds the row in single precision, separately, as it has vectors of its
    /// own.
    void
    add_single_precision(CaseData &data)
    {
      add_interleaved(data.name("matrix_free_float"), [&data] {
        const auto a = std::make_shared<Application>(data);
        const auto K = std::make_shared<SinglePrecision>(data.effective());
        K->x.copy_locally_owned_data_from(a->x);
        K->apply();
        a->y.copy_locally_owned_data_from(K->y);
        Counters counters =
          matrix_free_counters(data.problem(),
                               flops_per_cell(data.problem()).stiffness,
                               40);
        counters["bytes"] -= 8 * data.problem().n_unknowns();
        counters["unknowns"]   = data.problem().n_unknowns();
        counters["difference"] = a->difference(data.problem());
        return Measured{[K] { K->apply(); },
                        counters,
                        [K] {
                          K->x.add(K->y.l2_norm() > 0 ? 0.f : 1.f, K->y);
                        }};
      });
    }
  } // namespace

  void
  add_operators(CaseData &data)
  {
    add_long(data.name("assembly"),
             [&data] { return data.assembly_figures(); });
    add_matrix_formats(data);
    add_matrix_free(data);
    add_single_precision(data);
  }
} // namespace corotet::benchmarks
