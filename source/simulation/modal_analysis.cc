// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/simulation/modal_analysis.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace corotet
{
  namespace
  {
    using dealii::Tensor;

    std::map<unsigned int, double>
    densities(const std::map<unsigned int, IsotropicMaterial> &materials)
    {
      std::map<unsigned int, double> result;
      for (const auto &[region, material] : materials)
        result[region] = material.density;
      return result;
    }

    // Diagonal of the body's bounding box.
    double
    body_length(const Discretization &disc)
    {
      Tensor<1, 3> extent;
      for (unsigned int a = 0; a < 3; ++a)
        {
          double lower = std::numeric_limits<double>::max();
          double upper = std::numeric_limits<double>::lowest();
          for (unsigned int n = 0; n < disc.n_owned_nodes(); ++n)
            {
              lower = std::min(lower, disc.node_position(n)[a]);
              upper = std::max(upper, disc.node_position(n)[a]);
            }
          extent[a] = dealii::Utilities::MPI::max(upper, disc.communicator()) -
                      dealii::Utilities::MPI::min(lower, disc.communicator());
        }
      return extent.norm();
    }

    // What scales x such that the largest displacement of a node is 1 and the
    // largest component is positive.
    double
    scale_to_one(const Vector &x)
    {
      double square = 0, lowest = 0, highest = 0;
      for (unsigned int i = 0; i < x.locally_owned_size(); i += 3)
        {
          double sum = 0;
          for (unsigned int a = 0; a < 3; ++a)
            {
              const double value = x.local_element(i + a);
              sum += value * value;
              lowest  = std::min(lowest, value);
              highest = std::max(highest, value);
            }
          square = std::max(square, sum);
        }
      const MPI_Comm comm = x.get_mpi_communicator();
      square              = dealii::Utilities::MPI::max(square, comm);
      lowest              = dealii::Utilities::MPI::min(lowest, comm);
      highest             = dealii::Utilities::MPI::max(highest, comm);
      return (-lowest > highest ? -1 : 1) / std::sqrt(square);
    }
  } // namespace

  ModalAnalysis::ModalAnalysis(SimulationParameters &parameters,
                               const std::string    &folder,
                               const MPI_Comm        comm,
                               Log                  &log)
    : parameters(parameters)
    , log(log)
    , mesh(parameters.mesh, folder, comm, log)
    , disc(mesh, parameters.element())
    , reference(disc.element())
    , conditions(parameters.boundary_conditions,
                 mesh.boundaries(),
                 read_table_functions(parameters.tables, folder, comm))
    , mass(disc,
           reference,
           densities(parameters.material.materials(mesh.regions())),
           mass_type(parameters.mass_type))
    , elastic(disc,
              reference,
              parameters.material.materials(mesh.regions()),
              Rotation::none)
    , motion(disc, reference, conditions, 0.)
    , A(disc, elastic, mass, motion.is_prescribed())
    , solver(A,
             parameters.linear_solver,
             0.1 * parameters.modes.tolerance,
             [this](const unsigned int n_solves) {
               this->log.progress(
                 fmt::format("modes: {} linear solves", n_solves));
             })
    , length(body_length(disc))
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
  ModalAnalysis::note_what_is_ignored() const
  {
    const LoadParameters no_loads;
    bool                 something = !conditions.tractions.empty() ||
                     !conditions.pressures.empty() ||
                     parameters.loads.gravity != no_loads.gravity ||
                     parameters.loads.body_force != no_loads.body_force ||
                     parameters.loads.point_forces != no_loads.point_forces;
    for (const auto &condition : conditions.displacements)
      for (const auto &component : condition.components)
        something = something || (component && !component->is_zero());
    if (something)
      log.line("Modes are those of the body at rest: loads are left out, and "
               "prescribed displacements count as zero");
  }

  void
  ModalAnalysis::compute()
  {
    ScopedTimer timer(wall_times.solve);
    parameters.linear_solver.limit_tolerance(0.01 * parameters.modes.tolerance);
    shift =
      parameters.modes.shift > 0 ? parameters.modes.shift : estimated_shift();
    const Eigenpairs pairs = solver.solve(parameters.modes.number, shift);
    for (const Vector &x : pairs.vectors)
      computed.push_back(make_mode(x));
    std::stable_sort(computed.begin(),
                     computed.end(),
                     [](const Mode &a, const Mode &b) {
                       return a.eigenvalue < b.eigenvalue;
                     });
    // Ghost entries have not come along.
    for (Mode &mode : computed)
      mode.shape.update_ghost_values();
    log_table();
    for (unsigned int i = 0; i < computed.size(); ++i)
      check(computed[i], i + 1);
  }

  double
  ModalAnalysis::estimated_shift() const
  {
    // (v_s / L)^2 with the slowest shear wave, times 1e-4: the lowest frequency
    // of a compact body is about v_s / L, that of one as slender as 1:100 a
    // hundredth of it. Much less would make the systems all but singular.
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
    mode.shape *= 0.01 * length * scale_to_one(x);
    Vector f(x), g(x), r(x);
    solver.apply(f, g, mode.shape);
    mode.modal_mass = mode.shape * g;
    mode.shape.update_ghost_values();
    // By the energy of the strain and not by phi . K phi: so that of a rigid
    // body mode is the square of its round-off, and never negative.
    mode.eigenvalue = 2 * elastic.state(mode.shape).energy / mode.modal_mass;
    mode.angular_frequency = std::sqrt(mode.eigenvalue);
    mode.frequency         = mode.angular_frequency / (2 * dealii::numbers::PI);

    r = f;
    r.add(-mode.eigenvalue, g);
    const double unit = std::max(mode.eigenvalue, shift) * norm(g);
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

  void
  ModalAnalysis::log_table() const
  {
    log.line(fmt::format("Modes: {} linear solves with {} iterations, shift "
                         "{:.3g} 1/s^2",
                         solver.n_linear_solves(),
                         solver.n_linear_iterations(),
                         shift));
    log.line(fmt::format("  {:>4} {:>14} {:>9}   {}",
                         "mode",
                         "frequency [Hz]",
                         "residual",
                         "effective mass in x, y, z [%]"));
    for (unsigned int i = 0; i < computed.size(); ++i)
      log.line(
        fmt::format("  {:>4} {:>14.7g} {:>9.2g}   {:>6.2f} {:>6.2f} {:>6.2f}",
                    i + 1,
                    computed[i].frequency,
                    computed[i].residual,
                    100 * computed[i].effective_mass[0] / mass.total(),
                    100 * computed[i].effective_mass[1] / mass.total(),
                    100 * computed[i].effective_mass[2] / mass.total()));
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
