// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/output/series_writer.h>

namespace corotet
{
  namespace
  {
    // The tables in the file of a result.
    std::vector<Hdf5File::NewTable>
    tables_of(const VtkhdfSeries &series)
    {
      std::vector<Hdf5File::NewTable> result;
      for (const auto &[name, n_columns] : series.point_data)
        result.push_back({"PointData/" + name, series.n_points, n_columns});
      for (const auto &[name, n_columns] : series.cell_data)
        result.push_back({"CellData/" + name, series.n_cells, n_columns});
      return result;
    }
  } // namespace

  SeriesWriter::SeriesWriter(const VtkhdfSeries &series)
    : series(series)
  {}

  void
  SeriesWriter::start(const Snapshot &initial)
  {
    series.make_folder(initial.discretization.communicator());
    write_mesh(initial);
    write_state(initial);
  }

  void
  SeriesWriter::transfer(Archive &archive)
  {
    series.transfer(archive);
  }

  void
  SeriesWriter::resume(const Snapshot &state)
  {
    const MPI_Comm comm = state.discretization.communicator();
    series.make_folder(comm);
    write_mesh(state);
    series.resume(state.record.step, comm);
  }

  void
  SeriesWriter::step(const Snapshot &state)
  {
    if (state.last || series.is_due(state.record.time))
      write_state(state);
  }

  void
  SeriesWriter::save(const Snapshot &state)
  {
    if (series.is_new(state.record.time))
      write_state(state);
  }

  void
  SeriesWriter::write_state(const Snapshot &state)
  {
    const MPI_Comm     comm = state.discretization.communicator();
    const unsigned int step = state.record.step;
    Hdf5File           file(series.result_file(step), comm);
    VtkhdfSeries::create_groups(file);
    file.create(tables_of(series));
    write_tables(file, state);
    file.finish();
    series.add_result(step, state.record.time, comm);
  }
} // namespace corotet
