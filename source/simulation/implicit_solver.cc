// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/implicit_solver.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <deal.II/base/scope_exit.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    constexpr double machine_precision = std::numeric_limits<double>::epsilon();
    // The smallest scale of forces relative to those at a guess: two solves
    // with an accuracy of 1e-8.
    constexpr double least_share = 1e-8;
    // The smallest relative tolerance of one linear solve.
    constexpr double least_tolerance = 1e-9;
  } // namespace

  ImplicitSolver::ImplicitSolver(
    EquationOfMotion             &equation,
    const NewtonParameters       &newton_parameters,
    const LinearSolverParameters &linear_solver_parameters,
    Log                          &log)
    : equation(equation)
    , body(equation.body)
    , parameters(newton_parameters)
    , newton(newton_parameters)
    , linear_solver(linear_solver_parameters)
    , log(log)
    , tangent(newton_parameters.tangent)
  {
    const ForceTerms &terms = equation.terms;
    if (TangentOperator::is_needed(body.elasticity, terms, tangent))
      linear_solver.check_fit(
        TangentOperator::is_symmetric(body.elasticity, terms, tangent));
    if (terms.has_surface_matrix())
      surface =
        std::make_unique<SurfaceMatrix>(body.discretization, body.reference);
  }

  void
  ImplicitSolver::make_operators()
  {
    ScopedTimer timer(equation.wall_times.assembly);
    if (!body.is_one_piece)
      parts = PartResiduals::of_several(body.discretization);
    effective_operator =
      std::make_unique<EffectiveOperator>(body.discretization,
                                          body.elasticity,
                                          body.mass,
                                          body.motion.is_prescribed(),
                                          surface.get());
    if (TangentOperator::is_needed(body.elasticity,
                                   equation.terms,
                                   parameters.tangent))
      tangent_operator = std::make_unique<TangentOperator>(*effective_operator,
                                                           body.elasticity,
                                                           equation.terms);
  }

  StageReport
  ImplicitSolver::solve_stage(State &state, const Stage &stage)
  {
    if (!effective_operator)
      make_operators();
    this->stage        = stage;
    stage_state        = &state;
    const bool statics = stage.acceleration_factor == 0;
    // Where all forces vanish, residuals are compared with those of the last
    // stage.
    stage_scale = solved_scale;
    worst_part  = {};
    if (parts)
      parts->start();
    NewtonReport report;
    try
      {
        const dealii::ScopeExit give_back([this] { kept = {}; });
        newton.solve(*this, state.u, report);
      }
    catch (const ComputationError &)
      {
        log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
        warn_of_far_motion();
        if (report.iterations == 0 && !std::isfinite(residual_norm))
          throw ComputationError(
            "the forces are not finite where Newton's method starts" +
            equation.why_not_finite());
        throw;
      }
    solved_scale = force_scale;
    if (parameters.linearly_implicit)
      // Newton's method has ended without an evaluation of the new state.
      equation.evaluate(state, stage.time, stage.load_factor);
    if (statics || parameters.always_log || report.line_searches > 0)
      log.line(fmt::format("t = {:.6g}: {}", stage.time, report.text()));
    report_round_off(report);
    report_parts(report);
    return {report.iterations,
            report.linear_iterations,
            report.observed_order()};
  }

  StageReport
  ImplicitSolver::move_supports(State       &state,
                                const double time,
                                const double load_factor)
  {
    Vector before(state.u);
    body.motion.apply(time, load_factor, state.u, state.v, state.a);
    Vector motion_of_supports(state.u);
    motion_of_supports -= before;
    if (is_linear() || norm(motion_of_supports) == 0)
      return {};
    if (!effective_operator)
      make_operators();
    // The tangent is taken at the state before the step.
    state.u.swap(before);
    stage       = {time, 0., 0., load_factor};
    stage_state = &state;
    Vector r, du, f;
    for (Vector *vector : {&r, &du, &f})
      body.discretization.initialize_vector(*vector);
    residual(r);
    // The last solve may have ended with the definite tangent.
    use_definite_tangent(false);
    const TangentOperator *J = linearize();
    // The derivatives of loads are left out, as this is only a guess.
    motion_of_supports.update_ghost_values();
    body.elasticity.apply_stiffness(f, motion_of_supports, tangent);
    effective_operator->add_surface(f, motion_of_supports);
    r -= f;
    body.motion.set_zero(r);
    unsigned int n_iterations = 0;
    try
      {
        n_iterations = solve_tangent_system(du, r, J);
        if (!std::isfinite(norm(du)))
          du = 0;
      }
    catch (const ComputationError &)
      {
        // Newton's method can choose another tangent, and reports forces that
        // are not finite.
        du = 0;
      }
    state.u.swap(before);
    state.u += du;
    return {1, n_iterations};
  }

  NewtonProblem::Norm
  ImplicitSolver::residual(Vector &r)
  {
    const auto &forces =
      equation.evaluate(*stage_state, stage.time, stage.load_factor);
    equation.residual(r);
    const std::array<const Vector *, 6> terms{
      {&r,
       &forces.external,
       &forces.internal,
       forces.damping.size() > 0 ? &forces.damping : nullptr,
       equation.is_dynamic ? &forces.inertia : nullptr,
       equation.terms.has_elastic() ? &forces.elastic : nullptr}};
    const auto sizes = norms<6>(terms);
    if (parts)
      parts->take({terms.begin() + 1, terms.end()});
    residual_norm  = sizes[0];
    external_force = sizes[1];
    inertia_force  = sizes[4];
    force_scale    = *std::max_element(sizes.begin() + 1, sizes.end());
    // Forces at a guess may be of any size. In a linear problem whose solution
    // has no forces, the round-off of those at the guess is the scale.
    if (is_linear())
      stage_scale = std::max(stage_scale, least_share * force_scale);
    const RoundOffOfForces noise = round_off();
    return {sizes[0],
            std::max(stage_scale, force_scale),
            noise.sure,
            noise.most};
  }

  NewtonProblem::Norm
  ImplicitSolver::improve_guess(Vector &r, const Norm &at_guess)
  {
    // A residual is fair if it is no larger than the forces of the step:
    // without the acceleration of the guess the inertia is missing, and some of
    // it may count twice.
    const double fair = std::max({inertia_force, external_force, solved_scale});
    Norm         best = at_guess;
    const auto is_fair = [&] { return best.is_finite() && best.value <= fair; };
    if (is_linear() || stage.start == nullptr || is_fair())
      return best;
    const auto try_without = [&](Vector &part) {
      body.motion.set_zero(part);
      add(-1., part);
      // A residual that is hardly smaller may belong to a state farther from
      // the solution.
      const Norm without = residual(r);
      if (without.value < 0.5 * best.value || !best.is_finite())
        {
          best = without;
          return;
        }
      add(1., part);
      best = residual(r);
    };
    Vector part(stage.start->a);
    part *= stage.guess_factor;
    try_without(part);
    if (is_fair())
      return best;
    part = stage_state->u;
    part -= stage.start->u;
    try_without(part);
    return best;
  }

  bool
  ImplicitSolver::is_linear() const
  {
    return equation.is_linear();
  }

  bool
  ImplicitSolver::update_surface()
  {
    if (!surface || (surface_factor == stage.velocity_factor &&
                     (surface_time == stage.time ||
                      !equation.terms.surface_matrix_depends_on_time()) &&
                     !equation.terms.surface_matrix_depends_on_motion()))
      return false;
    equation.terms.surface_matrix(*surface,
                                  equation.motion(stage.time),
                                  1.,
                                  stage.velocity_factor);
    surface_time   = stage.time;
    surface_factor = stage.velocity_factor;
    return true;
  }

  void
  ImplicitSolver::update_effective_operator()
  {
    const bool         has_new_surface = update_surface();
    const MatrixShares damping         = equation.terms.damping_shares();
    const double       c_K = 1 + stage.velocity_factor * damping.stiffness;
    const double       c_M =
      stage.acceleration_factor + stage.velocity_factor * damping.mass;
    if (!body.law->is_linear() || c_K != operator_c_K || c_M != operator_c_M ||
        has_new_surface)
      {
        ScopedTimer timer(equation.wall_times.assembly);
        effective_operator->update(c_K, c_M);
        operator_c_K = c_K;
        operator_c_M = c_M;
      }
  }

  const TangentOperator *
  ImplicitSolver::linearize()
  {
    update_effective_operator();
    if (!TangentOperator::is_needed(body.elasticity, equation.terms, tangent))
      return nullptr;
    ScopedTimer timer(equation.wall_times.assembly);
    clamped_cells = std::max(clamped_cells,
                             tangent_operator->update(equation.last_motion(),
                                                      tangent,
                                                      stage.load_factor,
                                                      stage.velocity_factor));
    return tangent_operator.get();
  }

  unsigned int
  ImplicitSolver::solve_linearized(Vector       &dx,
                                   const Vector &r,
                                   const double  tolerance)
  {
    return solve_tangent_system(dx, r, linearize(), tolerance);
  }

  unsigned int
  ImplicitSolver::solve_tangent_system(Vector                &dx,
                                       const Vector          &r,
                                       const TangentOperator *J,
                                       const double           tolerance)
  {
    ScopedTimer timer(equation.wall_times.solve);
    try
      {
        // A linear problem needs only one solve if that is as accurate as
        // Newton's method asks, relative to the forces known at the solution. A
        // tenth is left for the difference by round-off between this residual
        // and that of the forces.
        const double known = std::max(solved_scale, external_force);
        const double scale =
          std::max(stage_scale, known > 0 ? known : force_scale);
        // What one solve cannot reach is left to the next one.
        // A part that is left of a whole that is solved needs all digits.
        const double limit =
          is_linear() && worst_part.ratio == 0 ?
            std::max({0.9 * parameters.residual_tolerance * scale,
                      least_tolerance * norm(r),
                      hides_parts ? 0. : 0.9 * force_noise}) :
            std::numeric_limits<double>::infinity();
        const unsigned int n_builds     = preconditioner_builds();
        const unsigned int n_iterations = linear_solver.solve(
          *effective_operator, dx, r, stage_state->u, J, limit, tolerance);
        if (preconditioner_builds() > n_builds)
          {
            built_stage = stage;
            // Linear laws have no rotations that depend on the displacement.
            if (!body.law->is_linear() ||
                equation.terms.surface_matrix_depends_on_motion())
              built_displacement = stage_state->u;
            if (equation.terms.has_friction())
              built_velocity = stage_state->v;
            built_with_tangent = J != nullptr;
            built_tangent      = tangent;
          }
        report_linear_solver(n_iterations);
        return n_iterations;
      }
    catch (const ComputationError &error)
      {
        // The failure is not due to cells if the matrix is singular, or if the
        // tangent is exact, which may be almost singular: then the solve with
        // another tangent tells.
        if (dynamic_cast<const SingularMatrixError *>(&error) == nullptr &&
            (J == nullptr || !J->is_exact()))
          report_linear_solver(std::numeric_limits<unsigned int>::max());
        throw;
      }
  }

  NewtonProblem::Norm
  ImplicitSolver::add(const double factor, const Vector &dx)
  {
    stage_state->u.add(factor, dx);
    if (stage.velocity_factor != 0)
      stage_state->v.add(factor * stage.velocity_factor, dx);
    if (stage.acceleration_factor != 0)
      stage_state->a.add(factor * stage.acceleration_factor, dx);
    const auto [size, increment] = norms<2>({{&stage_state->u, &dx}});
    return {std::abs(factor) * increment,
            size,
            has_run_away ? 0. : 4 * machine_precision * size};
  }

  void
  ImplicitSolver::keep()
  {
    const auto copy = [&](dealii::VectorMemory<Vector>::Pointer &to,
                          const Vector                          &from) {
      if (!to)
        to = dealii::VectorMemory<Vector>::Pointer(memory);
      to->reinit(from, true);
      *to = from;
    };
    copy(kept.u, stage_state->u);
    if (stage.velocity_factor != 0)
      copy(kept.v, stage_state->v);
    if (stage.acceleration_factor != 0)
      copy(kept.a, stage_state->a);
  }

  void
  ImplicitSolver::restore()
  {
    stage_state->u = *kept.u;
    if (stage.velocity_factor != 0)
      stage_state->v = *kept.v;
    if (stage.acceleration_factor != 0)
      stage_state->a = *kept.a;
  }

  bool
  ImplicitSolver::has_energy() const
  {
    return equation.has_energy();
  }

  bool
  ImplicitSolver::use_definite_tangent(const bool use)
  {
    tangent = use ? Tangent::frozen_rotation : parameters.tangent;
    return parameters.tangent != Tangent::frozen_rotation &&
           (!body.law->is_linear() || equation.terms.has_friction());
  }
} // namespace corotet
