// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_modes_writer_h
#define corotet_output_modes_writer_h

#include <corotet/output/output_parameters.h>
#include <corotet/output/probes.h>
#include <corotet/simulation/modal_analysis.h>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * The columns of modes.csv with probes of these names.
   */
  std::vector<std::string>
  modes_columns(const std::vector<std::string> &probe_names);

  /**
   * Writes the results of a modal analysis: modes.csv with a row per mode, the
   * shapes as the steps of solution.vtkhdf, and summary.json.
   *
   * @p analysis must outlive this object. Members are collective.
   */
  class ModesWriter
  {
  public:
    /// Throws InputError if a probe is wrong.
    ModesWriter(const OutputParameters &parameters,
                const std::string      &directory,
                ModalAnalysis          &analysis);

    /// Writes what the analysis has computed; @p failure says why that is not
    /// all, and is empty if it is. Throws MachineError if a file cannot be
    /// written.
    void
    write(const std::string &failure);

  private:
    void
    write_table() const;
    void
    write_shapes() const;

    std::string    directory;
    ModalAnalysis &analysis;
    Probes         probes;
  };
} // namespace corotet

#endif
