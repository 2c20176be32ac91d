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
    : SeriesWriter(VtkhdfSeries(directory,
                                "stress_points",
                                time_between_results,
                                n_joined))
  {
    series.point_data  = {{"displacement", 3}};
    const auto &tables = StressTables::tables();
    series.point_data.insert(series.point_data.end(),
                             tables.begin(),
                             tables.end());
  }

  void
  StressPointsWriter::write_mesh(const Snapshot &state)
  {
    const Discretization &discretization = state.discretization;
    const MPI_Comm        comm           = discretization.communicator();
    const auto &rule    = state.stress().reference_element().stiffness_rule;
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

    Hdf5File file(series.mesh_file(), comm);
    cells->write(file, "Points", positions.data(), 3, n_points);
    file.write("Types", types.data(), list);
    file.write("Connectivity", connectivity.data(), list);
    VtkhdfSeries::write_offsets(file, list, 1, comm);
    series.write_sizes(file, list.n_global_rows);
    file.finish();
  }

  void
  StressPointsWriter::write_tables(Hdf5File &file, const Snapshot &state)
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
    cells->write(
      file, "PointData/displacement", displacements.data(), 3, n_points);
    tables.write(file);
  }
} // namespace corotet
