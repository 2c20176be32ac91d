// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/memory.h>
#include <corotet/mesh/curved_cells.h>
#include <corotet/output/stress_tables.h>
#include <corotet/output/vtkhdf_writer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/vector_memory.h>

#include <array>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Utilities::MPI::this_mpi_process;

    // The reference coordinates of the nodes of VTK's Lagrange tetrahedron.
    std::vector<Point<3>>
    vtk_nodes(const unsigned int degree)
    {
      const std::array<Point<3>, 4> vertices{
        {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
      const std::array<std::array<unsigned int, 2>, 6> edges{
        {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};
      const std::array<std::array<unsigned int, 3>, 4> faces{
        {{{0, 1, 3}}, {{1, 2, 3}}, {{0, 2, 3}}, {{0, 1, 2}}}};

      std::vector<Point<3>> nodes(vertices.begin(), vertices.end());
      for (const auto &[begin, end] : edges)
        for (unsigned int k = 1; k < degree; ++k)
          {
            const double s = double(k) / degree;
            nodes.emplace_back((1 - s) * vertices[begin] + s * vertices[end]);
          }
      if (degree == 3)
        for (const auto &[a, b, c] : faces)
          nodes.emplace_back((vertices[a] + vertices[b] + vertices[c]) / 3);
      return nodes;
    }
  } // namespace

  std::vector<unsigned int>
  vtk_node_order(const unsigned int degree)
  {
    const std::vector<Point<3>> &points =
      map_element(degree).get_unit_support_points();
    std::vector<unsigned int> order;
    for (const Point<3> &node : vtk_nodes(degree))
      for (unsigned int i = 0; i < points.size(); ++i)
        if (points[i].distance(node) < 1e-10)
          order.push_back(i);
    AssertDimension(order.size(), points.size());
    return order;
  }

  VtkhdfWriter::VtkhdfWriter(const std::string &directory,
                             const double       time_between_results,
                             const std::size_t  n_joined,
                             const bool         with_stress)
    : SeriesWriter(
        VtkhdfSeries(directory, "solution", time_between_results, n_joined))
    , with_stress(with_stress)
  {
    series.point_data = {{"displacement", 3}, {"velocity", 3}};
    series.cell_data  = {{"rotation_angle", 0}, {"det_F", 0}, {"von_mises", 0}};
    series.static_cell_data = {"region", "rank"};
    if (with_stress)
      {
        const auto &tables = StressTables::tables();
        series.point_data.insert(series.point_data.end(),
                                 tables.begin(),
                                 tables.end());
        series.cell_data.push_back({"error_estimate", 0});
      }
  }

  void
  VtkhdfWriter::write_mesh(const Snapshot &state)
  {
    const Discretization &discretization = state.discretization;
    const MPI_Comm        comm           = discretization.communicator();
    const unsigned int    n_cells        = discretization.n_owned_cells();
    if (discretization.element().has_bubbles())
      without_bubbles = std::make_unique<CoarserNodes>(discretization);
    const Nodes &shown  = without_bubbles ?
                            static_cast<const Nodes &>(*without_bubbles) :
                            discretization;
    nodes               = FileOrder::of_nodes(discretization, shown);
    cells               = FileOrder::of_cells(discretization);
    const Hdf5Rows rows = cells->rows();
    series.n_points     = nodes->rows().n_global_rows;
    series.n_cells      = rows.n_global_rows;

    Hdf5File file(series.mesh_file(), comm);
    write_nodal(file, "Points", discretization.node_positions());
    write_connectivity(shown, file);

    const std::vector<std::uint8_t> types(rows.n_rows, 71);
    file.write("Types", types.data(), rows);
    std::vector<std::int32_t> regions(n_cells);
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      regions[cell] = discretization.region(cell);
    cells->write(file, "region", regions.data());
    const std::vector<std::int32_t> ranks(n_cells, this_mpi_process(comm));
    cells->write(file, "rank", ranks.data());

    series.write_sizes(file, rows.n_global_rows * shown.n_nodes_per_cell());
    file.finish();
  }

  void
  VtkhdfWriter::write_nodal(Hdf5File          &file,
                            const std::string &name,
                            const Vector      &values)
  {
    if (!without_bubbles)
      {
        nodes->write(file, name, values.begin(), 3);
        return;
      }
    std::vector<double> shown(std::size_t(3) *
                              without_bubbles->n_owned_nodes());
    for (unsigned int n = 0; n < without_bubbles->n_owned_nodes(); ++n)
      for (unsigned int a = 0; a < 3; ++a)
        shown[3 * n + a] =
          values.local_element(3 * without_bubbles->key(n) + a);
    nodes->write(file, name, shown.data(), 3);
  }

  void
  VtkhdfWriter::write_connectivity(const Nodes &shown, Hdf5File &file)
  {
    const std::vector<unsigned int> order = vtk_node_order(shown.degree());
    const hsize_t                   n     = shown.n_nodes_per_cell();

    // Row numbers of all local nodes in a vector: doubles represent them
    // exactly.
    Vector row;
    shown.initialize_vector(row);
    const std::vector<std::int64_t> owned_rows = nodes->row_numbers();
    for (std::size_t i = 0; i < owned_rows.size(); ++i)
      row.local_element(3 * i) = static_cast<double>(owned_rows[i]);
    row.update_ghost_values();
    std::vector<std::int64_t> connectivity;
    connectivity.reserve(shown.n_owned_cells() * n);
    for (unsigned int cell = 0; cell < shown.n_owned_cells(); ++cell)
      for (const unsigned int i : order)
        connectivity.push_back(static_cast<std::int64_t>(
          row.local_element(3 * shown.cell_nodes(cell)[i])));
    const Hdf5Rows rows = cells->rows();
    cells->write(file, "Connectivity", connectivity.data(), 0, n);

    VtkhdfSeries::write_offsets(file, rows, n, shown.communicator());
  }

  void
  VtkhdfWriter::write_tables(Hdf5File &file, const Snapshot &state)
  {
    // Releases memory that the linear solver keeps for its next call, to have
    // room for the rows.
    dealii::GrowingVectorMemory<Vector>::release_unused_memory();
    release_free_memory();
    const CellResults results = state.cell_results();

    write_nodal(file, "PointData/displacement", state.displacement);
    if (state.velocity.size() > 0)
      write_nodal(file, "PointData/velocity", state.velocity);
    else
      {
        const Hdf5Rows            rows = nodes->rows(3);
        const std::vector<double> zeros(3 * rows.n_rows);
        file.write("PointData/velocity", zeros.data(), rows);
      }
    cells->write(file,
                 "CellData/rotation_angle",
                 results.rotation_angle.data());
    cells->write(file, "CellData/det_F", results.det_F.data());
    cells->write(file, "CellData/von_mises", results.von_mises.data());
    if (with_stress)
      write_stress(file, state.stress());
  }

  void
  VtkhdfWriter::write_stress(Hdf5File &file, StressField &stress) const
  {
    const auto   values = stress.at_nodes();
    StressTables tables(*nodes);
    const auto   n_nodes =
      without_bubbles ? without_bubbles->n_owned_nodes() : values.stress.size();
    for (unsigned int n = 0; n < n_nodes; ++n)
      {
        const unsigned int node = without_bubbles ? without_bubbles->key(n) : n;
        tables.add(values.stress[node], values.strain[node]);
      }
    tables.write(file);
    cells->write(file,
                 "CellData/error_estimate",
                 stress.error().of_cells.data());
  }
} // namespace corotet
