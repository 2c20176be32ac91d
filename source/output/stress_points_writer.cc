// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/material/stress_measures.h>
#include <corotet/output/stress_points_writer.h>
#include <corotet/output/stress_tables.h>

#include <deal.II/base/mpi.h>

#include <numeric>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  StressPointsWriter::StressPointsWriter(const std::string &directory,
                                         const double      time_between_results,
                                         const std::size_t n_joined)
    : series(directory, "stress_points", time_between_results, n_joined)
  {
    series.point_data  = {{"displacement", 3}};
    const auto &tables = StressTables::tables();
    series.point_data.insert(series.point_data.end(),
                             tables.begin(),
                             tables.end());
  }

  void
  StressPointsWriter::start(const Snapshot &initial)
  {
    series.make_folder(initial.discretization.communicator());
    write_mesh(initial.discretization, initial.stress().reference_element());
    write_state(initial);
  }

  void
  StressPointsWriter::resume(const Snapshot &state)
  {
    series.make_folder(state.discretization.communicator());
    write_mesh(state.discretization, state.stress().reference_element());
    series.resume(state.record.step, state.discretization.communicator());
  }

  void
  StressPointsWriter::step(const Snapshot &state)
  {
    if (state.last || series.is_due(state.record.time))
      write_state(state);
  }

  void
  StressPointsWriter::save(const Snapshot &state)
  {
    if (series.is_new(state.record.time))
      write_state(state);
  }

  void
  StressPointsWriter::write_mesh(const Discretization   &discretization,
                                 const ReferenceElement &reference)
  {
    const MPI_Comm comm = discretization.communicator();
    const auto    &rule = reference.stiffness_rule;
    cells               = FileOrder::of_cells(discretization);
    n_points            = rule.weights.size();
    const Hdf5Rows list = cells->rows(0, n_points);
    series.n_points = series.n_cells = list.n_global_rows;

    std::vector<double> positions;
    positions.reserve(3 * n_points * discretization.n_owned_cells());
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      for (unsigned int q = 0; q < rule.weights.size(); ++q)
        {
          const Point<3> x = point_position(discretization, rule, c, q);
          positions.insert(positions.end(), {x[0], x[1], x[2]});
        }
    const std::vector<std::uint8_t> types(list.n_rows, 1);
    std::vector<std::int64_t>       connectivity(list.n_rows);
    std::iota(connectivity.begin(), connectivity.end(), list.first);
    // Offsets has an entry more than there are cells. Rank 0 writes it, the
    // leading zero.
    const bool root = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    std::vector<std::int64_t> offsets(list.n_rows + (root ? 1 : 0));
    const hsize_t             first_offset = list.first + (root ? 0 : 1);
    std::iota(offsets.begin(), offsets.end(), first_offset);

    Hdf5File file(series.mesh_file(), comm);
    cells->write(file, "Points", positions.data(), 3, n_points);
    file.write("Types", types.data(), list);
    file.write("Connectivity", connectivity.data(), list);
    file.write("Offsets",
               offsets.data(),
               {first_offset, offsets.size(), list.n_global_rows + 1});
    series.write_sizes(file, list.n_global_rows);
    file.finish();
  }

  void
  StressPointsWriter::write_state(const Snapshot &state)
  {
    const Discretization &discretization = state.discretization;
    StressField          &field          = state.stress();
    const auto           &stresses       = field.at_points();
    const auto           &rule = field.reference_element().stiffness_rule;

    StressTables        tables(*cells, n_points);
    std::vector<double> displacements;
    displacements.reserve(3 * stresses.size());
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const IsotropicMaterial &material =
          field.law().material(field.law().material_index(c));
        const auto nodes = discretization.cell_nodes(c);
        for (unsigned int q = 0; q < n_points; ++q)
          {
            Tensor<1, 3> u;
            for (unsigned int i = 0; i < nodes.size(); ++i)
              for (unsigned int a = 0; a < 3; ++a)
                u[a] += rule.values(q, i) *
                        state.displacement.local_element(3 * nodes[i] + a);
            displacements.insert(displacements.end(), {u[0], u[1], u[2]});
            const auto &sigma = stresses[c * n_points + q];
            tables.add(sigma, strain_of_stress(material, sigma));
          }
      }
    const MPI_Comm comm = discretization.communicator();
    Hdf5File       file(series.result_file(state.record.step), comm);
    VtkhdfSeries::create_groups(file);
    cells->write(
      file, "PointData/displacement", displacements.data(), 3, n_points);
    tables.write(file);
    file.finish();
    series.add_result(state.record.step, state.record.time, comm);
  }
} // namespace corotet
