// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_series_writer_h
#define corotet_output_series_writer_h

#include <corotet/output/vtkhdf_series.h>
#include <corotet/simulation/observer.h>

namespace corotet
{
  /**
   * An observer that writes a time series for ParaView: which states it has,
   * the first and the last among them, and how it goes on after a restart.
   * Members throw MachineError if a file cannot be written.
   */
  class SeriesWriter : public Observer
  {
  public:
    void
    start(const Snapshot &initial) override;

    void
    transfer(Archive &archive) override;

    /// Also writes the mesh again: the ranks of its cells may be others.
    void
    resume(const Snapshot &state) override;

    void
    step(const Snapshot &state) override;

    void
    save(const Snapshot &state) override;

  protected:
    explicit SeriesWriter(const VtkhdfSeries &series);

    /// Writes the file of the mesh, as VtkhdfSeries says. Collective.
    virtual void
    write_mesh(const Snapshot &state) = 0;

    /// Writes the tables of a result, in the groups that they belong to.
    /// Collective.
    virtual void
    write_tables(Hdf5File &file, const Snapshot &state) = 0;

    VtkhdfSeries series;

  private:
    void
    write_state(const Snapshot &state);
  };
} // namespace corotet

#endif
