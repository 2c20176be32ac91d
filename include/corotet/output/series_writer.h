// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_series_writer_h
#define corotet_output_series_writer_h

#include <corotet/output/vtkhdf_series.h>
#include <corotet/simulation/observer.h>

namespace corotet
{
  /**
   * An observer that writes a time series for ParaView. It decides which states
   * are written, among them the first and the last, and continues the series
   * after a restart. Members throw MachineError if a file cannot be written.
   */
  class SeriesWriter : public Observer
  {
  public:
    void
    start(const Snapshot &initial) override;

    void
    transfer(Archive &archive) override;

    /// Continues the series; writes the mesh again, as the ranks of its cells
    /// may have changed.
    void
    resume(const Snapshot &state) override;

    void
    step(const Snapshot &state) override;

    void
    save(const Snapshot &state) override;

  protected:
    explicit SeriesWriter(const VtkhdfSeries &series);

    /// Writes the file of the mesh, described in VtkhdfSeries. Collective.
    virtual void
    write_mesh(const Snapshot &state) = 0;

    /// Writes the tables of a result, each in its group. Collective.
    virtual void
    write_tables(Hdf5File &file, const Snapshot &state) = 0;

    VtkhdfSeries series;

  private:
    void
    write_state(const Snapshot &state);
  };
} // namespace corotet

#endif
