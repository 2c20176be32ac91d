// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/output/vtkhdf_writer.h>

#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <system_error>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Utilities::MPI::this_mpi_process;

    // What is stored once, by name: all that VTK's reader wants in group
    // VTKHDF.
    const std::vector<std::string> mesh_tables{"NumberOfPoints",
                                               "NumberOfCells",
                                               "NumberOfConnectivityIds",
                                               "Points",
                                               "Connectivity",
                                               "Offsets",
                                               "Types"};
    const std::vector<std::string> static_cell_data{"region", "rank"};

    // What is stored for each result: tables with a row per node (three
    // columns) and lists with a number per cell.
    const std::vector<std::string> point_data{"displacement", "velocity"};
    const std::vector<std::string> cell_data{"rotation_angle",
                                             "det_F",
                                             "von_mises"};

    // Reference coordinates of the nodes of VTK's Lagrange tetrahedron.
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
    Assert(degree >= 1 && degree <= 3, dealii::ExcIndexRange(degree, 1, 4));
    const dealii::FE_SimplexP<3> fe(degree);
    const auto                  &points = fe.get_unit_support_points();
    std::vector<unsigned int>    order;
    for (const Point<3> &node : vtk_nodes(degree))
      for (unsigned int i = 0; i < points.size(); ++i)
        if (points[i].distance(node) < 1e-10)
          order.push_back(i);
    AssertDimension(order.size(), points.size());
    return order;
  }

  VtkhdfWriter::VtkhdfWriter(const std::string &directory,
                             const double       time_between_results,
                             const std::size_t  n_joined)
    : directory(directory)
    , time_between_results(time_between_results)
    , n_joined(n_joined)
  {}

  void
  VtkhdfWriter::start(const Snapshot &initial)
  {
    const Discretization &discretization = initial.discretization;
    const MPI_Comm        comm           = discretization.communicator();
    on_root(comm, [&] {
      std::error_code error;
      std::filesystem::create_directories(directory + "/solution", error);
      if (error)
        throw MachineError(
          directory +
          "/solution: the folder cannot be made: " + error.message());
    });
    write_mesh(discretization);
    write_state(initial);
  }

  void
  VtkhdfWriter::step(const Snapshot &state)
  {
    if (state.last || is_due(state.record.time))
      write_state(state);
  }

  void
  VtkhdfWriter::save(const Snapshot &state)
  {
    if (state.record.time > times.back())
      write_state(state);
  }

  bool
  VtkhdfWriter::is_due(const double time) const
  {
    if (time_between_results == 0)
      return true;
    // A step that ends at a multiple, but for round-off, has reached it.
    const auto interval = [&](const double t) {
      return std::floor(t / time_between_results + 1e-6);
    };
    return interval(time) > interval(times.back());
  }

  void
  VtkhdfWriter::write_mesh(const Discretization &discretization)
  {
    const MPI_Comm     comm    = discretization.communicator();
    const unsigned int n_cells = discretization.n_owned_cells();
    if (discretization.element().has_bubbles())
      without_bubbles = std::make_unique<CoarserNodes>(discretization);
    const Nodes       &shown   = without_bubbles ?
                                   static_cast<const Nodes &>(*without_bubbles) :
                                   discretization;
    const unsigned int n_nodes = shown.n_owned_nodes();
    // Owned nodes are numbered consecutively, rank after rank.
    nodes.first  = n_nodes > 0 ? static_cast<hsize_t>(shown.global_node(0)) : 0;
    nodes.n_rows = n_nodes;
    nodes.n_global_rows = shown.n_global_nodes();
    nodes.n_columns     = 3;
    cells.first         = dealii::Utilities::MPI::partial_and_total_sum(
                    static_cast<hsize_t>(n_cells), comm)
                    .first;
    cells.n_rows        = n_cells;
    cells.n_global_rows = discretization.n_global_cells();
    cells.n_columns     = 0;

    Hdf5File file(directory + "/solution/mesh.h5", comm);
    write_nodal(file, "Points", discretization.node_positions());
    write_connectivity(shown, file);

    const std::vector<std::uint8_t> types(n_cells, 71);
    file.write("Types", types.data(), cells);
    std::vector<std::int32_t> regions(n_cells);
    for (unsigned int cell = 0; cell < n_cells; ++cell)
      regions[cell] = discretization.geometry(cell).region;
    file.write("region", regions.data(), cells);
    const std::vector<std::int32_t> ranks(n_cells, this_mpi_process(comm));
    file.write("rank", ranks.data(), cells);

    const auto list = [](const hsize_t number) {
      return std::vector<std::int64_t>{static_cast<std::int64_t>(number)};
    };
    file.write_from_root("NumberOfPoints", list(nodes.n_global_rows));
    file.write_from_root("NumberOfCells", list(cells.n_global_rows));
    file.write_from_root("NumberOfConnectivityIds",
                         list(cells.n_global_rows * shown.n_nodes_per_cell()));
    file.finish();
  }

  void
  VtkhdfWriter::write_nodal(Hdf5File          &file,
                            const std::string &name,
                            const Vector      &values)
  {
    if (!without_bubbles)
      {
        file.write(name, values.begin(), nodes);
        return;
      }
    std::vector<double> shown(3 * nodes.n_rows);
    for (unsigned int n = 0; n < nodes.n_rows; ++n)
      for (unsigned int a = 0; a < 3; ++a)
        shown[3 * n + a] =
          values.local_element(3 * without_bubbles->key(n) + a);
    file.write(name, shown.data(), nodes);
  }

  void
  VtkhdfWriter::write_connectivity(const Nodes &shown, Hdf5File &file)
  {
    const std::vector<unsigned int> order = vtk_node_order(shown.degree());
    const hsize_t                   n     = shown.n_nodes_per_cell();

    std::vector<std::int64_t> connectivity;
    connectivity.reserve(cells.n_rows * n);
    // Offsets has an entry more than there are cells. Rank 0 writes it, the
    // leading zero.
    const bool root = this_mpi_process(shown.communicator()) == 0;
    std::vector<std::int64_t> offsets;
    offsets.reserve(cells.n_rows + 1);
    if (root)
      offsets.push_back(0);
    for (unsigned int cell = 0; cell < cells.n_rows; ++cell)
      {
        for (const unsigned int i : order)
          connectivity.push_back(shown.global_node(shown.cell_nodes(cell)[i]));
        offsets.push_back((cells.first + cell + 1) * n);
      }
    file.write("Connectivity",
               connectivity.data(),
               {cells.first * n, cells.n_rows * n, cells.n_global_rows * n});
    file.write("Offsets",
               offsets.data(),
               {cells.first + (root ? 0 : 1),
                offsets.size(),
                cells.n_global_rows + 1});
  }

  std::string
  VtkhdfWriter::Block::file_name() const
  {
    if (level == 0)
      return fmt::format("step_{:06}.h5", step);
    if (level == 1)
      return fmt::format("block_{:06}.h5", step);
    return fmt::format("block_{}_{:06}.h5", level, step);
  }

  void
  VtkhdfWriter::write_state(const Snapshot &state)
  {
    const MPI_Comm    comm    = state.discretization.communicator();
    const CellResults results = state.cell_results();

    const Block block{0, state.record.step, 1};

    Hdf5File file(directory + "/solution/" + block.file_name(), comm);
    write_nodal(file, "displacement", state.displacement);
    write_nodal(file, "velocity", state.velocity);
    file.write("rotation_angle", results.rotation_angle.data(), cells);
    file.write("det_F", results.det_F.data(), cells);
    file.write("von_mises", results.von_mises.data(), cells);
    file.finish();

    times.push_back(state.record.time);
    blocks.push_back(block);
    on_root(comm, [&] {
      join_blocks();
      write_index();
    });
  }

  void
  VtkhdfWriter::join_blocks()
  {
    // Levels never rise from one block to the next.
    while (blocks.size() >= n_joined &&
           blocks[blocks.size() - n_joined].level == blocks.back().level)
      {
        const std::size_t first = blocks.size() - n_joined;
        const Block       joined{blocks[first].level + 1,
                           blocks[first].step,
                           blocks[first].n_results * n_joined};
        Hdf5File          file(directory + "/solution/" + joined.file_name(),
                      MPI_COMM_SELF);
        write_references(file, first, "", "", "");
        file.finish();
        blocks.resize(first);
        blocks.push_back(joined);
      }
  }

  void
  VtkhdfWriter::write_references(Hdf5File          &file,
                                 const std::size_t  first_block,
                                 const std::string &folder,
                                 const std::string &point_group,
                                 const std::string &cell_group) const
  {
    std::vector<Hdf5Part> point_parts, cell_parts;
    for (std::size_t i = first_block; i < blocks.size(); ++i)
      {
        const std::string name = folder + blocks[i].file_name();
        point_parts.push_back(
          {name, blocks[i].n_results * nodes.n_global_rows});
        cell_parts.push_back({name, blocks[i].n_results * cells.n_global_rows});
      }
    for (const std::string &name : point_data)
      file.write_virtual(point_group + name,
                         name,
                         point_parts,
                         nodes.n_columns);
    for (const std::string &name : cell_data)
      file.write_virtual(cell_group + name, name, cell_parts, cells.n_columns);
  }

  void
  VtkhdfWriter::write_index() const
  {
    Hdf5File file(directory + "/solution.vtkhdf", MPI_COMM_SELF);
    file.create_group("VTKHDF");
    file.write_number_attribute("VTKHDF", "Version", {2, 0});
    file.write_text_attribute("VTKHDF", "Type", "UnstructuredGrid");
    for (const std::string &name : mesh_tables)
      file.link("VTKHDF/" + name, "solution/mesh.h5", name);

    file.create_group("VTKHDF/PointData");
    file.create_group("VTKHDF/CellData");
    write_references(
      file, 0, "solution/", "VTKHDF/PointData/", "VTKHDF/CellData/");
    for (const std::string &name : static_cell_data)
      file.link("VTKHDF/CellData/" + name, "solution/mesh.h5", name);

    write_index_steps(file);
    file.finish();
  }

  void
  VtkhdfWriter::write_index_steps(Hdf5File &file) const
  {
    const std::string steps = "VTKHDF/Steps";
    file.create_group(steps);
    file.write_number_attribute(steps,
                                "NSteps",
                                {static_cast<std::int64_t>(times.size())});
    file.write_from_root(steps + "/Values", times);

    // Where the tables of each step begin: the mesh and what belongs to it are
    // the same rows for all.
    const std::vector<std::int64_t> same(times.size(), 0);
    file.write_from_root(steps + "/PartOffsets", same);
    file.write_from_root(steps + "/NumberOfParts",
                         std::vector<std::int64_t>(times.size(), 1));
    file.write_from_root(steps + "/PointOffsets", same);
    file.write_from_root(steps + "/CellOffsets", same, 1);
    file.write_from_root(steps + "/ConnectivityIdOffsets", same, 1);

    const auto consecutive = [&](const hsize_t n_rows) {
      std::vector<std::int64_t> offsets(times.size());
      for (std::size_t i = 0; i < offsets.size(); ++i)
        offsets[i] = i * n_rows;
      return offsets;
    };
    file.create_group(steps + "/PointDataOffsets");
    for (const std::string &name : point_data)
      file.write_from_root(steps + "/PointDataOffsets/" + name,
                           consecutive(nodes.n_global_rows));
    file.create_group(steps + "/CellDataOffsets");
    for (const std::string &name : cell_data)
      file.write_from_root(steps + "/CellDataOffsets/" + name,
                           consecutive(cells.n_global_rows));
    for (const std::string &name : static_cell_data)
      file.write_from_root(steps + "/CellDataOffsets/" + name, same);
  }
} // namespace corotet
