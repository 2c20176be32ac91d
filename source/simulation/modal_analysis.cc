// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/modal_analysis.h>
#include <corotet/solvers/linear_solver_errors.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    // The precision of omega^2 relative to the much larger terms that it is a
    // sum of: three digits less than that of numbers [-].
    constexpr double share_of_round_off =
      1000 * std::numeric_limits<double>::epsilon();

    std::vector<Vector>
    rigid_body_modes(const Discretization &disc, const RigidMotions &motions)
    {
      std::vector<Vector> result(motions.size());
      for (unsigned int k = 0; k < result.size(); ++k)
        {
          disc.initialize_vector(result[k]);
          motions.evaluate(result[k], k);
        }
      return result;
    }

    // The largest displacement of a node.
    double
    largest_displacement(const Vector &x)
    {
      double square = 0;
      for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
        {
          double sum = 0;
          for (unsigned int a = 0; a < 3; ++a)
            sum += x.local_element(i + a) * x.local_element(i + a);
          square = std::max(square, sum);
        }
      return std::sqrt(
        dealii::Utilities::MPI::max(square, x.get_mpi_communicator()));
    }
  } // namespace

  ModalAnalysis::ModalAnalysis(const SimulationParameters &parameters,
                               const std::string          &folder,
                               const MPI_Comm              comm,
                               Log                        &log)
    : parameters(parameters)
    , log(log)
    , the_body(parameters, folder, comm, log, Body::Purpose::small_vibrations)
    , terms(parameters.forces.make_for_modes(
        the_body.force_context(log, parameters.start_time)))
    , surface(terms.springs(the_body.reference, parameters.start_time))
    , rigid_motions(the_body.discretization,
                    the_body.motion,
                    surface ? surface->springs() :
                              std::vector<RigidMotions::Spring>())
    , A(the_body.discretization,
        the_body.elasticity,
        the_body.mass,
        the_body.motion.is_prescribed(),
        surface.get())
    , linear_solver(parameters.linear_solver, 0.01 * parameters.modes.tolerance)
    , solver(A,
             linear_solver,
             0.1 * parameters.modes.tolerance,
             rigid_body_modes(the_body.discretization, rigid_motions),
             [this](const unsigned int n_solves) {
               this->log.progress(
                 fmt::format("modes: {} linear solves", n_solves));
               const std::string news = linear_solver.take_news();
               if (!news.empty())
                 this->log.line(news);
             })
    , box(the_body.discretization.bounding_box())
    , length(box.first.distance(box.second))
  {
    if (parameters.modes.number > solver.max_eigenvalues())
      throw InputError(
        "Modes/Number",
        solver.max_eigenvalues() == 0 ?
          fmt::format("found {}; the {} unknowns that are not prescribed are "
                      "too few for modes: needed are 16",
                      parameters.modes.number,
                      solver.n_free_unknowns()) :
          fmt::format("found {}; allowed: at most {} with the {} unknowns that "
                      "are not prescribed (a quarter of them; none of fewer "
                      "than 16)",
                      parameters.modes.number,
                      solver.max_eigenvalues(),
                      solver.n_free_unknowns()));
    check_shift();
    the_body.describe(log);
    note_what_is_ignored();
    wall_times.setup     = seconds();
    wall_times.read      = the_body.mesh.read_time();
    wall_times.partition = the_body.mesh.partition_time();
  }

  void
  ModalAnalysis::compute()
  {
    ScopedTimer timer(wall_times.solve);
    choose_shift();
    // The estimate for a mode that deforms the body.
    const double     with_strain = lowest;
    const Eigenpairs pairs       = solve();
    if (pairs.values.size() > rigid_motions.size())
      lowest = pairs.values[rigid_motions.size()];
    if (!rigid_motions.is_complete())
      lowest = std::max(lowest, shift);
    for (const Vector &x : pairs.vectors)
      computed.push_back(make_mode(x));
    std::stable_sort(
      computed.begin() +
        std::min<std::size_t>(rigid_motions.size(), computed.size()),
      computed.end(),
      [](const Mode &a, const Mode &b) { return a.eigenvalue < b.eigenvalue; });
    // Sorting has not kept the ghost entries of shapes up to date.
    for (Mode &mode : computed)
      mode.shape.update_ghost_values();
    log_table();
    note_cut_group(pairs.values);
    for (unsigned int i = 0; i < computed.size(); ++i)
      {
        check(computed[i], i + 1);
        if (i >= rigid_motions.size() &&
            computed[i].eigenvalue < share_of_round_off * with_strain)
          log.warning(fmt::format(
            "mode {} ({:.6g} Hz): omega^2 is {:.1g} times that of the lowest "
            "mode that deforms the body, which is as little as round-off: its "
            "frequency may be wrong",
            i + 1,
            computed[i].frequency,
            computed[i].eigenvalue / with_strain));
      }
  }

  Eigenpairs
  ModalAnalysis::solve()
  {
    try
      {
        return solver.solve(parameters.modes.number, shift);
      }
    catch (const ComputationError &error)
      {
        // With less, rigid motions drown all else in solves with A.
        constexpr double least = 1e-6;
        if (parameters.modes.shift == 0 || !(shift < least * lowest))
          throw;
        const bool is_singular =
          dynamic_cast<const SingularMatrixError *>(&error) != nullptr;
        throw ComputationError(fmt::format(
          "Modes/Shift: found {:.6g} 1/s^2, which is too small: {}; allowed: a "
          "larger one, best {:.3g} to {:.3g} 1/s^2, 1e-3 to 0.1 times omega^2 "
          "of the lowest mode that deforms the body (0: the program's choice)",
          shift,
          is_singular ? "round-off makes K + s M singular" : error.what(),
          1e-3 * lowest,
          0.1 * lowest));
      }
  }

  void
  ModalAnalysis::check_shift() const
  {
    // No mode of the mesh has a larger omega^2 than this bound: (c_p / h)^2
    // with the speed c_p of pressure waves and the smallest height h of a cell,
    // times a generous factor for elements of degree 3 and for the shapes of
    // cells.
    double largest = 0;
    for (unsigned int c = 0; c < the_body.discretization.n_owned_cells(); ++c)
      {
        const CellGeometry      &geometry = the_body.discretization.geometry(c);
        const IsotropicMaterial &material =
          the_body.materials.at(geometry.region);
        largest =
          std::max(largest,
                   (material.lambda + 2 * material.mu) / material.density *
                     geometry.inverse_jacobian.norm_square());
      }
    const double bound =
      1e4 * dealii::Utilities::MPI::max(largest,
                                        the_body.discretization.communicator());
    if (parameters.modes.shift > bound)
      throw InputError(
        "Modes/Shift",
        fmt::format(
          "found {:.6g} 1/s^2; allowed: less than {:.3g} 1/s^2, which "
          "is above omega^2 of all modes, and best 1e-3 to 0.1 times "
          "that of the lowest one (0: the program's choice)",
          parameters.modes.shift,
          bound));
  }

  void
  ModalAnalysis::choose_shift()
  {
    // With a larger shift all modes that are wanted look alike to the solver:
    // it takes very long, and in the end errors exceed the differences of
    // modes.
    constexpr double most = 10;
    // Soft springs resist rigid motions, but these deform nothing.
    const Discretization &disc = the_body.discretization;
    const RigidMotions    without_strain(disc, the_body.motion);
    const double          first_look = estimated_shift();
    lowest                           = solver.lowest_eigenvalue(first_look,
                                      rigid_body_modes(disc, without_strain),
                                      true);
    shift                            = 0.01 * lowest;
    // A solve with A amplifies a rigid motion more than other modes, by the
    // ratio of their Rayleigh quotients. If that exceeds a million, the other
    // modes drown in the noise of the rigid motion.
    if (without_strain.size() > rigid_motions.size())
      shift =
        std::max(0.01 *
                   solver.lowest_eigenvalue(
                     first_look, rigid_body_modes(disc, rigid_motions), false),
                 1e-6 * lowest);
    if (parameters.modes.shift > 0)
      shift = parameters.modes.shift;
    if (!(shift <= most * lowest))
      throw ComputationError(
        fmt::format("Modes/Shift: found {:.6g} 1/s^2; allowed: up to {:.3g} "
                    "1/s^2, {:.0f} times omega^2 of the lowest mode that "
                    "deforms the body, best 1e-3 to 0.1 times (0: the "
                    "program's choice)",
                    shift,
                    most * lowest,
                    most));
  }

  double
  ModalAnalysis::estimated_shift() const
  {
    // A first guess: (v_s / L)^2 of the slowest shear wave, times 1e-4. The
    // lowest frequency of a compact body is about v_s / L, that of a slender
    // one (1:100) a hundredth of it.
    double square = std::numeric_limits<double>::max();
    for (const auto &[region, material] : the_body.materials)
      square = std::min(square, material.mu / material.density);
    return 1e-4 * square / (length * length);
  }

  Mode
  ModalAnalysis::make_mode(const Vector &x) const
  {
    Mode mode;
    the_body.discretization.initialize_vector(mode.shape);
    mode.shape.copy_locally_owned_data_from(x);
    mode.shape *= sign(x) * 0.01 * length / largest_displacement(x);
    Vector f(x), g(x), r(x);
    solver.apply(f, g, mode.shape);
    mode.modal_mass = mode.shape * g;
    mode.shape.update_ghost_values();
    // The eigenvalue comes from the energy of the strain and not from phi . K
    // phi: so that of a rigid body mode is the square of its round-off, and
    // never negative.
    const double energy =
      the_body.elasticity.state(mode.shape).energy +
      terms.energy({parameters.start_time, mode.shape, mode.shape});
    mode.eigenvalue        = 2 * energy / mode.modal_mass;
    mode.angular_frequency = std::sqrt(mode.eigenvalue);
    mode.frequency         = mode.angular_frequency / (2 * dealii::numbers::PI);

    r = f;
    r.add(-mode.eigenvalue, g);
    const double unit = std::max(mode.eigenvalue, lowest) * norm(g);
    mode.residual     = norm(r) / unit;
    // The bound of the round-off in a sum of n terms is n epsilon times the sum
    // of their sizes. A row i has at most some three hundred terms, whose sizes
    // sum up to about three times K_ii phi_i. In a body far from the origin,
    // places of nodes and with them motions of the body are rounded, too.
    const double distance =
      std::max(Tensor<1, 3>(box.first).norm(), Tensor<1, 3>(box.second).norm());
    const double n_roundings = 1000 + 4 * distance / length;
    for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
      r.local_element(i) =
        A.diagonal().local_element(i) * mode.shape.local_element(i);
    mode.round_off =
      n_roundings * std::numeric_limits<double>::epsilon() * norm(r) / unit;

    // The participation includes the nodes of supports, which phi moves through
    // M.
    the_body.mass.apply(g, mode.shape);
    Tensor<1, 3> participation;
    for (unsigned int i = 0; i < g.locally_owned_size(); ++i)
      participation[i % 3] += g.local_element(i);
    participation =
      dealii::Utilities::MPI::sum(participation,
                                  the_body.discretization.communicator());
    for (unsigned int a = 0; a < 3; ++a)
      mode.effective_mass[a] =
        participation[a] * participation[a] / mode.modal_mass;
    return mode;
  }

  double
  ModalAnalysis::sign(const Vector &x) const
  {
    // Products with waves whose directions and phases match no symmetry of a
    // body. The product that is farthest from zero decides. If two are equally
    // far, it would be chance which one is taken, but that is unlikely.
    constexpr unsigned int      n_waves = 8;
    std::array<double, n_waves> products{};
    const Vector               &mass = the_body.mass.diagonal();
    for (unsigned int n = 0; n < the_body.discretization.n_owned_nodes(); ++n)
      {
        const Tensor<1, 3> r =
          (the_body.discretization.node_position(n) - box.first) / length;
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double weight =
              mass.local_element(3 * n + a) * x.local_element(3 * n + a);
            const double phase = std::numbers::sqrt2 * r[a] +
                                 std::numbers::sqrt3 * r[(a + 1) % 3] +
                                 std::sqrt(5.) * r[(a + 2) % 3];
            for (unsigned int k = 0; k < n_waves; ++k)
              products[k] +=
                weight * std::sin((k + 1) * phase + 0.7 * (a + 1) + 1.1 * k);
          }
      }
    double largest = 0;
    for (const double product : products)
      {
        const double sum =
          dealii::Utilities::MPI::sum(product,
                                      the_body.discretization.communicator());
        if (std::abs(sum) > std::abs(largest))
          largest = sum;
      }
    return largest < 0 ? -1. : 1.;
  }

  void
  ModalAnalysis::check(const Mode &mode, const unsigned int number) const
  {
    const double allowed = std::max(parameters.modes.tolerance, mode.round_off);
    if (!(mode.residual <= allowed))
      throw ComputationError(
        fmt::format("mode {} ({:.6g} Hz) has a residual of {:.3g}; required is "
                    "{:.3g}",
                    number,
                    mode.frequency,
                    mode.residual,
                    allowed));
  }

  RunSummary
  ModalAnalysis::summary() const
  {
    RunSummary result;
    the_body.fill_in(result);
    result.steps           = computed.size();
    result.wall_times      = wall_times;
    result.total_wall_time = seconds();
    return result;
  }

  double
  ModalAnalysis::seconds() const
  {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         started)
      .count();
  }
} // namespace corotet
