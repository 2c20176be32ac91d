// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/linear.h>
#include <corotet/simulation/body.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace corotet
{
  namespace
  {
    // The time step; if the run chooses it, the time that a wave takes through
    // the smallest cell. Zero where nothing moves in time.
    double
    time_scale(const SimulationParameters                      &parameters,
               const Discretization                            &discretization,
               const std::map<unsigned int, IsotropicMaterial> &materials,
               const Body::Purpose                              purpose)
    {
      if (purpose == Body::Purpose::small_vibrations ||
          !parameters.time_integrator.selected().is_dynamic())
        return 0;
      if (parameters.time_step > 0)
        return parameters.time_step;
      double shortest = std::numeric_limits<double>::max();
      for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
        {
          const auto              &geometry = discretization.geometry(c);
          const IsotropicMaterial &material = materials.at(geometry.region);
          const double             speed =
            std::sqrt((material.lambda + 2 * material.mu) / material.density);
          shortest = std::min(shortest, std::cbrt(6 * geometry.volume) / speed);
        }
      return dealii::Utilities::MPI::min(shortest,
                                         discretization.communicator());
    }
  } // namespace

  Body::Body(const SimulationParameters  &parameters,
             const TableFunctions        &tables,
             const std::function<Mesh()> &make_mesh,
             const Purpose                purpose)
    : tables(tables)
    , mesh(make_mesh())
    , discretization(mesh, parameters.element())
    , reference(ReferenceElement::of(discretization.element()))
    , problem(parameters, purpose == Purpose::motion)
    , materials(parameters.material.materials(mesh.regions()))
    , law(purpose == Purpose::motion ?
            parameters.material.law(discretization.degree()) :
            linear_law())
    , conditions(problem.boundary_conditions(mesh.boundaries()),
                 mesh.places(),
                 tables)
    , mass(discretization, reference, densities(materials), parameters.mass)
    , elasticity(discretization,
                 reference,
                 materials,
                 law,
                 parameters.material.dilatation_of(discretization.degree()))
    , motion(discretization,
             reference,
             conditions,
             time_scale(parameters, discretization, materials, purpose))
  {
    // The chosen law must be the linear one at rest, also for modal analyses.
    const auto chosen = parameters.material.law(discretization.degree());
    for (const auto &[region, material] : materials)
      check_at_rest(*chosen, material);
  }

  Body::Body(const SimulationParameters &parameters,
             const std::string          &folder,
             const MPI_Comm              comm,
             Log                        &log,
             const Purpose               purpose)
    : Body(
        parameters,
        read_table_functions(parameters.tables, folder, comm),
        [&] {
          return Mesh(
            parameters.mesh, folder, comm, log, parameters.element().degree());
        },
        purpose)
  {}

  Body::Body(const SimulationParameters &parameters,
             SerialMesh                  serial_mesh,
             const MPI_Comm              comm,
             Log                        &log)
    : Body(
        parameters,
        {},
        [&] {
          return Mesh(std::move(serial_mesh),
                      0,
                      1.,
                      comm,
                      log,
                      parameters.element().degree());
        },
        Purpose::motion)
  {}

  ForceContext
  Body::force_context(Log &log, const double start_time)
  {
    return {discretization,
            reference,
            mass,
            elasticity,
            conditions,
            tables,
            log,
            start_time};
  }

  double
  Body::root_mean_square(const Vector &field) const
  {
    const Vector &diagonal = mass.diagonal();
    if (sum_of_nodal_masses == 0)
      // The mass of each node counts for its three unknowns.
      sum_of_nodal_masses = diagonal.mean_value() * diagonal.size() / 3;
    double sum = 0;
    for (unsigned int i = 0; i < field.locally_owned_size(); ++i)
      sum += diagonal.local_element(i) * field.local_element(i) *
             field.local_element(i);
    return std::sqrt(
      dealii::Utilities::MPI::sum(sum, discretization.communicator()) /
      sum_of_nodal_masses);
  }

  void
  Body::describe(Log &log) const
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(discretization.communicator());
    log.line(
      fmt::format("Discretization: degree {}{}{}, {} cells, {} nodes, {} "
                  "unknowns on {} rank{}",
                  discretization.degree(),
                  discretization.element().has_bubbles() ? " with bubbles" : "",
                  elasticity.vertex_dilatation() != nullptr ?
                    " with dilatations of vertices" :
                    "",
                  discretization.n_global_cells(),
                  discretization.n_global_nodes(),
                  3 * discretization.n_global_nodes(),
                  n_ranks,
                  n_ranks == 1 ? "" : "s"));
    log.line(fmt::format("Body: {:.6g} kg", mass.total()));
  }

  void
  Body::fill_in(RunSummary &summary) const
  {
    summary.ranks =
      dealii::Utilities::MPI::n_mpi_processes(discretization.communicator());
    summary.degree      = discretization.degree();
    summary.cells       = discretization.n_global_cells();
    summary.nodes       = discretization.n_global_nodes();
    summary.unknowns    = std::size_t(3) * discretization.n_global_nodes();
    summary.mesh_volume = discretization.volume();
    summary.total_mass  = mass.total();
  }
} // namespace corotet
