// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// What round-off leaves of residuals, and when it does not excuse them.

#include <corotet/operators/force_round_off.h>
#include <corotet/simulation/implicit_solver.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

namespace corotet
{
  namespace
  {
    constexpr double precision = std::numeric_limits<double>::epsilon();
    // The displacement, in sizes of the body, beyond which there is no
    // equilibrium with its supports.
    constexpr double far_away = 1e3;
  } // namespace

  ImplicitSolver::RoundOffOfForces
  ImplicitSolver::round_off()
  {
    const ForceRoundOff &noise = effective_operator->force_round_off();
    const double         sure =
      noise.of_displacement(equation.displacement()) +
      4 * precision * force_scale +
      equation.terms.round_off(equation.last_motion(), external_force, noise);
    const double most = sure + noise.of_rotations();
    has_run_away      = external_force > 0 && most > external_force &&
                   times_its_size() > far_away;
    force_noise = has_run_away ? 0. : sure;
    return {force_noise, has_run_away ? 0. : most};
  }

  double
  ImplicitSolver::times_its_size() const
  {
    // In dynamics inertia resists, and bodies may move any distance.
    if (equation.is_dynamic)
      return 0;
    const Vector &u           = equation.displacement();
    const auto   &prescribed  = body.motion.is_prescribed();
    double        of_supports = 0;
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      if (prescribed[i] != 0)
        of_supports = std::max(of_supports, std::abs(u.local_element(i)));
    of_supports =
      dealii::Utilities::MPI::max(of_supports,
                                  body.discretization.communicator());
    return u.linfty_norm() / (of_supports + size_of_body());
  }

  double
  ImplicitSolver::size_of_body() const
  {
    const auto [lower, upper] = body.discretization.bounding_box();
    return lower.distance(upper);
  }

  double
  ImplicitSolver::unexplained_residual(const Vector &r)
  {
    const double size = equation.displacement().linfty_norm() + size_of_body();
    // Forces of an assembled matrix have round-off that is not in balance: that
    // of stiff parts moves soft ones.
    const double result = linear_solver.is_assembled() ?
                            norm(r) :
                            effective_operator->unexplained(
                              r, ForceRoundOff::error_of_displacements(size));
    hides_parts = hides_parts || result > parameters.residual_tolerance *
                                            std::max(stage_scale, force_scale);
    return result;
  }

  double
  ImplicitSolver::residual_of_parts(const Vector &r)
  {
    if (!parts)
      return 0;
    worst_part = parts->worst(r,
                              equation.displacement(),
                              effective_operator->squares_of_node_stiffness());
    return worst_part.ratio;
  }

  void
  ImplicitSolver::report_parts(const NewtonReport &report)
  {
    if (report.unsolved_part == 0 || has_warned_of_parts)
      return;
    has_warned_of_parts        = true;
    const dealii::Point<3> &at = parts->centre(worst_part.part);
    log.warning(fmt::format(
      "t = {:.6g}: the part of the mesh around ({:.6g}, {:.6g}, {:.6g}), which "
      "is not connected with the others, is not solved: its residual is {:.2g} "
      "of its forces, as those of the others are so much larger. Compute it by "
      "itself",
      stage.time,
      at[0],
      at[1],
      at[2],
      report.unsolved_part));
  }

  void
  ImplicitSolver::warn_of_far_motion()
  {
    // Rubber is drawn to a few times its length, not more.
    constexpr double too_far = 10;
    if (has_warned_of_far_motion)
      return;
    const double distance    = times_its_size();
    has_warned_of_far_motion = distance > too_far;
    if (has_warned_of_far_motion)
      log.warning(fmt::format("the loads move the body by {:.2g} times its "
                              "size: are its lengths in m, Young's modulus in "
                              "Pa and the loads in N, Pa and N/m^3?",
                              distance));
  }

  void
  ImplicitSolver::report_round_off(const NewtonReport &report)
  {
    using RoundOff = NewtonReport::RoundOff;
    if (report.round_off == RoundOff::none ||
        !shown_round_off.insert(report.round_off).second)
      return;
    const double      size = equation.displacement().linfty_norm();
    const std::string text = fmt::format(
      "t = {:.6g}: round-off ended Newton's iterations, which is not said "
      "again: {}; the residual is {:.2g} of the forces",
      stage.time,
      report.round_off == RoundOff::of_residual ?
        fmt::format("displacements of up to {:.3g} m, known to {:.1g} m, leave "
                    "no smaller residual",
                    size,
                    precision * size) :
        "an increment was no more than the round-off of the displacement",
      report.final_residual);
    constexpr double large = 1e-3;
    if (report.iterations > 1 && report.history.back().increment > large)
      log.warning(fmt::format("{}, and the last increment {:.2g} of the "
                              "displacement",
                              text,
                              report.history.back().increment));
    else
      log.line(text);
  }
} // namespace corotet
