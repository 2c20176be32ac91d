// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/discretization/cell_proportions.h>
#include <corotet/solvers/automatic.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace corotet
{
  namespace
  {
    // Times measured on one core, on plates and blocks of 700 to 170,000
    // unknowns. Only their ratios matter, which are much the same on other
    // processors. Seconds per unknown: of an iteration with degrees above 1 and
    // with degree 1, of making the matrix, and of ordering. Seconds per
    // operation of a factorisation, and per entry of the factor in a solve.
    constexpr double iteration_time   = 60e-9;
    constexpr double iteration_time_1 = 250e-9;
    constexpr double matrix_time      = 1.5e-6;
    constexpr double ordering_time    = 8e-6;
    constexpr double operation_time   = 1 / 25e9;
    constexpr double entry_time       = 1e-9;
    // With the dilatation of vertices, iterations and the matrix take longer by
    // this factor.
    constexpr double wide_rows = 3;

    // From degree 1 to a degree with r times as many unknowns, operations of a
    // factorisation grow by r^2.25 and entries of the factor by r^1.5: measured
    // powers are between 1.9 and 2.6, and between 1.35 and 1.65.
    constexpr double power_of_operations = 2.25;
    constexpr double power_of_entries    = 1.5;

    // Factors with more entries than these, 2 GB, are only made for users who
    // ask for them.
    constexpr double most_entries = 2.5e8;

    // Poisson's ratio of materials that are nearly incompressible.
    constexpr double incompressible = 0.48;

    // Solves with factors, even of an older matrix, take about three
    // iterations. The multigrid needs some 30 on cells as meshing programs make
    // them: these do not count as wasted.
    constexpr double       direct_iterations = 3;
    constexpr unsigned int usual_iterations  = 30;

    // Where the multigrid has no factors of degree 1, their size is computed
    // when a solve takes this many iterations: ordering a large matrix takes
    // time, and conjugate gradients that start again lose some iterations.
    constexpr unsigned int slow = 100;

    // The smallest measured number of iterations per unit of the mean ratio of
    // cells that are flat or stretched: without rotations of vertices, and with
    // them on flat and on stretched cells. On flat cells of degree 3 they grow
    // by the square root of the ratio above growth_begins.
    constexpr double iterations_by_ratio           = 10;
    constexpr double iterations_by_flat_ratio      = 4.5;
    constexpr double iterations_by_stretched_ratio = 1.3;
    constexpr double growth_begins                 = 10;

    double
    least_iterations(const CellProportions &cells,
                     const bool             has_rotations,
                     const unsigned int     degree)
    {
      const double ratio = cells.mean_ratio;
      if (!has_rotations)
        return iterations_by_ratio * ratio;
      if (cells.share_stretched > cells.share_flat)
        return iterations_by_stretched_ratio * ratio;
      const double growth =
        degree > 2 ? std::sqrt(std::max(1., ratio / growth_begins)) : 1.;
      return iterations_by_flat_ratio * ratio * growth;
    }

    // Number of solves after which factors are judged, as hard ones come
    // together, at the beginning of a step; the excess of their cost over that
    // of the multigrid that is allowed until then, in first factorisations; and
    // the iterations that the multigrid may waste, relative to the cost of
    // factors, before they are tried again.
    constexpr unsigned int trial                   = 10;
    constexpr double       patience_with_trial     = 4;
    constexpr double       patience_with_multigrid = 4;
  } // namespace

  void
  AutomaticPreconditioner::find_costs(const EffectiveOperator &A)
  {
    has_costs                                 = true;
    const Discretization      &discretization = A.discretization();
    const double               n = 3. * discretization.n_global_nodes();
    VertexLevel::Factorization degree_1;
    try
      {
        degree_1 = multigrid.lowest_level().factorization(A);
      }
    // A factor of degree 1 that is too large, for the memory or for the
    // library, means that the one of the whole matrix is, too.
    catch (const ComputationError &)
      {
        is_settled = true;
        return;
      }
    catch (const MachineError &)
      {
        is_settled = true;
        return;
      }
    const double r = n / degree_1.n_unknowns;
    const double n_operations =
      degree_1.n_operations * std::pow(r, power_of_operations);
    const double n_entries = degree_1.n_entries * std::pow(r, power_of_entries);
    if (n_entries > most_entries)
      {
        is_settled = true;
        return;
      }
    // Ranks share the work of an iteration, but not that of a factorisation.
    // Matrices with the dilatation of vertices have more entries.
    const double width =
      A.elasticity().vertex_dilatation() != nullptr ? wide_rows : 1.;
    const double iteration =
      n *
      (discretization.degree() == 1 ? iteration_time_1 * width :
                                      iteration_time) /
      dealii::Utilities::MPI::n_mpi_processes(discretization.communicator());
    costs.again =
      (n * matrix_time * width + n_operations * operation_time) / iteration;
    costs.first = costs.again + n * ordering_time / iteration;
    costs.solve = 1 + n_entries * entry_time / iteration;
  }

  void
  AutomaticPreconditioner::build(const EffectiveOperator &A,
                                 const Vector            &displacement)
  {
    build_for(A, nullptr, displacement);
  }

  void
  AutomaticPreconditioner::build_for(const EffectiveOperator &A,
                                     const TangentOperator   *J,
                                     const Vector            &displacement)
  {
    if (is_direct)
      {
        factorize(A, J, displacement);
        return;
      }
    multigrid.build(A, displacement);
    if (is_settled || has_costs || !multigrid.lowest_level().has_factors())
      return;
    find_costs(A);
    if (is_settled)
      return;
    const CellProportions &proportions = multigrid.proportions();
    if (proportions.mean_ratio < 2 * CellProportions::limit)
      return;
    const double forecast =
      least_iterations(proportions,
                       multigrid.lowest_level().has_rotations(),
                       A.discretization().degree());
    if (forecast < costs.first)
      return;
    news =
      fmt::format("Linear solver: a sparse factorisation, as costly as "
                  "{:.0f} iterations of p-multigrid, where at least {:.0f} "
                  "are to be expected: {}",
                  costs.first,
                  forecast,
                  proportions.text());
    // The forecast is compared with the cost of later solves with factors.
    n_multigrid = 1;
    iterations  = forecast;
    is_direct   = true;
    factorize(A, J, displacement);
  }

  void
  AutomaticPreconditioner::factorize(const EffectiveOperator &A,
                                     const TangentOperator   *J,
                                     const Vector            &displacement)
  {
    std::string reason;
    try
      {
        if (!direct)
          direct = std::make_unique<CholeskyDirect>();
        // With well-shaped cells exact tangents are indefinite only far from
        // the solution, and take several factorisations there that the next
        // iterate cannot use. In nearly incompressible bodies the stiffness of
        // the volume dominates; it is that of the deformed body, which the
        // frozen matrix does not have.
        if (!has_factors_of_tangents)
          has_factors_of_tangents =
            A.elasticity().largest_poissons_ratio() > incompressible ||
            cell_proportions(A.discretization()).are_poor();
        direct->build_for(A,
                          *has_factors_of_tangents ? J : nullptr,
                          displacement);
        return;
      }
    // The factor may be too large, for the memory or for the library, or the
    // matrix singular up to round-off: conjugate gradients may go on where a
    // factorisation cannot.
    catch (const ComputationError &error)
      {
        reason = error.what();
      }
    catch (const MachineError &error)
      {
        reason = error.what();
      }
    news += fmt::format("{}Linear solver: p-multigrid, as a factorisation has "
                        "failed: {}",
                        news.empty() ? "" : "\n",
                        reason);
    is_settled = true;
    leave_factors();
    multigrid.build(A, displacement);
  }

  void
  AutomaticPreconditioner::leave_factors()
  {
    is_direct   = false;
    n_multigrid = 0;
    iterations  = 0;
    in_vain     = 0;
    n_direct    = 0;
    direct_cost = 0;
    direct.reset();
  }

  void
  AutomaticPreconditioner::update(const EffectiveOperator &A)
  {
    if (!is_direct)
      multigrid.update(A);
  }

  void
  AutomaticPreconditioner::vmult(Vector &dst, const Vector &src) const
  {
    if (is_direct)
      direct->vmult(dst, src);
    else
      multigrid.vmult(dst, src);
  }

  void
  AutomaticPreconditioner::vmult_with_norm(Vector       &dst,
                                           const Vector &src,
                                           const double  src_norm) const
  {
    if (is_direct)
      direct->vmult(dst, src);
    else
      multigrid.vmult_with_norm(dst, src, src_norm);
  }

  unsigned int
  AutomaticPreconditioner::acceptable_iterations(const unsigned int first) const
  {
    return is_direct ? direct->acceptable_iterations(first) :
                       multigrid.acceptable_iterations(first);
  }

  double
  AutomaticPreconditioner::too_many(const unsigned int n) const
  {
    if (n <= usual_iterations)
      return 0;
    return std::max(0., n - direct_iterations * costs.solve);
  }

  unsigned int
  AutomaticPreconditioner::patience(const bool is_new,
                                    const bool is_tangent) const
  {
    if (is_settled || (is_direct && is_new))
      return std::numeric_limits<unsigned int>::max();
    if (is_direct)
      return direct->acceptable_iterations(0) + costs.again / costs.solve;
    if (!has_costs)
      return slow;
    const double left = (wait > 0 ? wait : costs.first) - in_vain;
    if (left > 0 && is_tangent && !multigrid.proportions().are_poor())
      return std::numeric_limits<unsigned int>::max();
    return std::max<double>(usual_iterations,
                            left + direct_iterations * costs.solve);
  }

  bool
  AutomaticPreconditioner::change(const EffectiveOperator &A,
                                  const TangentOperator   *J,
                                  const Vector            &displacement,
                                  const unsigned int       n_iterations,
                                  const double             n_expected)
  {
    if (!has_costs)
      {
        find_costs(A);
        return false;
      }
    if (is_direct)
      {
        direct_cost += n_iterations * costs.solve;
        factorize(A, J, displacement);
        return true;
      }
    ++n_multigrid;
    news = fmt::format("Linear solver: a sparse factorisation takes the place "
                       "of p-multigrid, whose iterations, {:.0f} by now, have "
                       "cost as much: {}",
                       iterations + n_iterations,
                       multigrid.proportions().text());
    iterations += n_expected;
    is_direct = true;
    factorize(A, J, displacement);
    return true;
  }

  bool
  AutomaticPreconditioner::take_note(const unsigned int n_iterations,
                                     const bool         was_built)
  {
    if (is_settled)
      return false;
    if (!is_direct)
      {
        ++n_multigrid;
        iterations += n_iterations;
        in_vain += too_many(n_iterations);
        return false;
      }
    ++n_direct;
    // The cost of the first factorisation is sunk and no reason to give up
    // factors.
    direct_cost += n_iterations * costs.solve +
                   (was_built && n_direct > 1 ? costs.again : 0);
    const double allowed =
      n_direct < trial ? patience_with_trial * costs.first : 0;
    if (n_multigrid == 0 ||
        direct_cost <= n_direct * iterations / n_multigrid + allowed)
      return false;
    news = fmt::format("Linear solver: p-multigrid again, as {} "
                       "solves with factors of the matrix have cost {:.0f} "
                       "of its iterations each, and it took {:.0f}",
                       n_direct,
                       direct_cost / n_direct,
                       iterations / n_multigrid);
    wait = std::max(2 * wait, patience_with_multigrid * direct_cost);
    leave_factors();
    return true;
  }

  std::string
  AutomaticPreconditioner::take_news()
  {
    return std::exchange(news, "");
  }

  void
  AutomaticPreconditioner::transfer(Archive &archive)
  {
    archive.transfer("is_direct", is_direct);
    archive.transfer("is_settled", is_settled);
    archive.transfer("has_costs", has_costs);
    archive.transfer("n_multigrid", n_multigrid);
    archive.transfer("iterations", iterations);
    archive.transfer("in_vain", in_vain);
    archive.transfer("wait", wait);
    archive.transfer("n_direct", n_direct);
    archive.transfer("direct_cost", direct_cost);
    archive.transfer("cost_of_first", costs.first);
    archive.transfer("cost_of_next", costs.again);
    archive.transfer("cost_of_solve", costs.solve);
    archive.within("p_multigrid", [&] { multigrid.transfer(archive); });
  }
} // namespace corotet
