// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/laws/linear.h>
#include <corotet/simulation/modal_analysis.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    // Lower and upper corner, the same on any number of ranks.
    std::pair<dealii::Point<3>, dealii::Point<3>>
    bounding_box(const Discretization &disc)
    {
      std::pair<dealii::Point<3>, dealii::Point<3>> box;
      for (unsigned int a = 0; a < 3; ++a)
        {
          double lower = std::numeric_limits<double>::max();
          double upper = std::numeric_limits<double>::lowest();
          for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
            {
              lower = std::min(lower, disc.node_position(n)[a]);
              upper = std::max(upper, disc.node_position(n)[a]);
            }
          box.first[a] =
            dealii::Utilities::MPI::min(lower, disc.communicator());
          box.second[a] =
            dealii::Utilities::MPI::max(upper, disc.communicator());
        }
      return box;
    }

    std::optional<SurfaceMatrix>
    stiffness_of(const ForceTerms       &terms,
                 const Discretization   &disc,
                 const ReferenceElement &reference,
                 const double            time)
    {
      std::optional<SurfaceMatrix> result;
      if (terms.has_surface_matrix())
        terms.surface_matrix(result.emplace(disc, reference), time, 1., 0.);
      return result;
    }

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

    // Largest displacement of a node.
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

  ModalAnalysis::ModalAnalysis(SimulationParameters &parameters,
                               const std::string    &folder,
                               const MPI_Comm        comm,
                               Log                  &log)
    : parameters(parameters)
    , log(log)
    , mesh(parameters.mesh, folder, comm, log, parameters.element().degree())
    , disc(mesh, parameters.element())
    , reference(disc.element())
    , tables(read_table_functions(parameters.tables, folder, comm))
    , conditions(parameters.boundary_conditions, mesh.boundaries(), tables)
    , mass(disc,
           reference,
           densities(parameters.material.materials(mesh.regions())),
           mass_type(parameters.mass_type))
    , elastic(disc,
              reference,
              parameters.material.materials(mesh.regions()),
              linear_law())
    , terms(parameters.forces.make_for_modes({disc,
                                              reference,
                                              mass,
                                              elastic,
                                              conditions,
                                              tables,
                                              log,
                                              parameters.start_time}))
    , motion(disc, reference, conditions, 0.)
    , surface(stiffness_of(terms, disc, reference, parameters.start_time))
    , rigid_motions(disc,
                    motion,
                    surface ? surface->springs() :
                              std::vector<RigidMotions::Spring>())
    , A(disc,
        elastic,
        mass,
        motion.is_prescribed(),
        surface ? &*surface : nullptr)
    , solver(A,
             parameters.linear_solver,
             0.1 * parameters.modes.tolerance,
             rigid_body_modes(disc, rigid_motions),
             [this](const unsigned int n_solves) {
               this->log.progress(
                 fmt::format("modes: {} linear solves", n_solves));
             })
    , box(bounding_box(disc))
    , length(box.first.distance(box.second))
  {
    if (parameters.modes.number > solver.max_eigenvalues())
      throw InputError(
        "Modes/Number",
        fmt::format(
          "found {}; allowed: at most {} with the {} unknowns that are "
          "not prescribed (a quarter of them; none of fewer than "
          "16)",
          parameters.modes.number,
          solver.max_eigenvalues(),
          solver.n_free_unknowns()));
    log.line(fmt::format(
      "Discretization: degree {}, {} cells, {} nodes, {} unknowns on {} rank{}",
      disc.degree(),
      disc.n_global_cells(),
      disc.n_global_nodes(),
      3 * disc.n_global_nodes(),
      dealii::Utilities::MPI::n_mpi_processes(comm),
      dealii::Utilities::MPI::n_mpi_processes(comm) == 1 ? "" : "s"));
    log.line(fmt::format("Body: {:.6g} kg", mass.total()));
    note_what_is_ignored();
    wall_times.setup = seconds();
  }

  ModalAnalysis::~ModalAnalysis()
  {
    // The parameters' solver may live longer than the matrix that it knows.
    parameters.linear_solver.clear();
  }

  void
  ModalAnalysis::compute()
  {
    ScopedTimer timer(wall_times.solve);
    parameters.linear_solver.limit_tolerance(0.01 * parameters.modes.tolerance);
    choose_shift();
    const Eigenpairs pairs = solver.solve(parameters.modes.number, shift);
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
    // Ghost entries have not come along.
    for (Mode &mode : computed)
      mode.shape.update_ghost_values();
    log_table();
    note_cut_group(pairs.values);
    for (unsigned int i = 0; i < computed.size(); ++i)
      check(computed[i], i + 1);
  }

  void
  ModalAnalysis::choose_shift()
  {
    // With more, all modes that are wanted look alike to the solver: it takes
    // ages, and in the end errors are larger than differences.
    constexpr double most = 10;
    lowest                = solver.lowest_eigenvalue(estimated_shift());
    shift = parameters.modes.shift > 0 ? parameters.modes.shift : 0.01 * lowest;
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
    // (v_s / L)^2 with the slowest shear wave, times 1e-4: the lowest frequency
    // of a compact body is about v_s / L, that of one as slender as 1:100 a
    // hundredth of it. Enough for a first look.
    double square = std::numeric_limits<double>::max();
    for (const auto &[region, material] :
         parameters.material.materials(mesh.regions()))
      square = std::min(square, material.mu / material.density);
    return 1e-4 * square / (length * length);
  }

  Mode
  ModalAnalysis::make_mode(const Vector &x) const
  {
    Mode mode;
    disc.initialize_vector(mode.shape);
    mode.shape.copy_locally_owned_data_from(x);
    mode.shape *= sign(x) * 0.01 * length / largest_displacement(x);
    Vector f(x), g(x), r(x);
    solver.apply(f, g, mode.shape);
    mode.modal_mass = mode.shape * g;
    mode.shape.update_ghost_values();
    // By the energy of the strain and not by phi . K phi: so that of a rigid
    // body mode is the square of its round-off, and never negative.
    const double energy =
      elastic.state(mode.shape).energy +
      terms.energy({parameters.start_time, mode.shape, mode.shape});
    mode.eigenvalue        = 2 * energy / mode.modal_mass;
    mode.angular_frequency = std::sqrt(mode.eigenvalue);
    mode.frequency         = mode.angular_frequency / (2 * dealii::numbers::PI);

    r = f;
    r.add(-mode.eigenvalue, g);
    const double unit = std::max(mode.eigenvalue, lowest) * norm(g);
    mode.residual     = norm(r) / unit;
    // The bound for a sum of n terms, n epsilon times the sum of their sizes:
    // row i has at most some three hundred, which are together some three times
    // K_ii phi_i.
    for (unsigned int i = 0; i < r.locally_owned_size(); ++i)
      r.local_element(i) =
        A.diagonal().local_element(i) * mode.shape.local_element(i);
    mode.round_off =
      1000 * std::numeric_limits<double>::epsilon() * norm(r) / unit;

    // Also from the nodes of supports, which phi moves through M.
    mass.apply(g, mode.shape);
    Tensor<1, 3> participation;
    for (unsigned int i = 0; i < g.locally_owned_size(); ++i)
      participation[i % 3] += g.local_element(i);
    participation =
      dealii::Utilities::MPI::sum(participation, disc.communicator());
    for (unsigned int a = 0; a < 3; ++a)
      mode.effective_mass[a] =
        participation[a] * participation[a] / mode.modal_mass;
    return mode;
  }

  double
  ModalAnalysis::sign(const Vector &x) const
  {
    // Products with waves of directions and phases that no body is symmetric
    // to. That one counts which is farthest from zero: whichever of two that
    // are alike it is would be chance, but that they are alike is, too.
    constexpr unsigned int      n_waves = 8;
    std::array<double, n_waves> products{};
    for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
      {
        const Tensor<1, 3> r = (disc.node_position(n) - box.first) / length;
        for (unsigned int a = 0; a < 3; ++a)
          {
            const double weight = mass.diagonal().local_element(3 * n + a) *
                                  x.local_element(3 * n + a);
            const double phase = std::sqrt(2.) * r[a] +
                                 std::sqrt(3.) * r[(a + 1) % 3] +
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
          dealii::Utilities::MPI::sum(product, disc.communicator());
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
    result.ranks = dealii::Utilities::MPI::n_mpi_processes(disc.communicator());
    result.degree = disc.degree();
    result.cells  = disc.n_global_cells();
    result.nodes  = disc.n_global_nodes();
    result.dofs   = 3 * disc.n_global_nodes();
    double volume = 0;
    for (unsigned int c = 0; c < disc.n_owned_cells(); ++c)
      volume += disc.geometry(c).volume;
    result.mesh_volume =
      dealii::Utilities::MPI::sum(volume, disc.communicator());
    result.total_mass      = mass.total();
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
