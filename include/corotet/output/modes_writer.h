// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_modes_writer_h
#define corotet_output_modes_writer_h

#include <corotet/output/output_parameters.h>
#include <corotet/output/probes.h>
#include <corotet/output/stress_probes.h>
#include <corotet/simulation/modal_analysis.h>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace corotet
{
  /**
   * A row as modes.csv has it with these @p parameters, without numbers.
   */
  nlohmann::ordered_json
  modes_example(const OutputParameters &parameters);

  /**
   * Writes the results of a modal analysis: modes.csv with a row per mode, the
   * shapes as the steps of solution.vtkhdf (and stress_points.vtkhdf), and
   * summary.json.
   *
   * @p analysis must outlive this object. Members are collective.
   */
  class ModesWriter
  {
  public:
    /// Throws InputError if a probe is wrong; the @p log says which were moved.
    ModesWriter(const OutputParameters &parameters,
                const std::string      &directory,
                ModalAnalysis          &analysis,
                Log                    &log);

    /// Writes the results of the analysis; @p failure is the reason why they
    /// are incomplete, empty if they are complete. Throws MachineError if a
    /// file cannot be written.
    void
    write(const std::string &failure);

  private:
    void
    write_table();
    void
    write_shapes();

    std::string    directory;
    ModalAnalysis &analysis;
    Probes         probes;
    StressProbes   stress_probes;
    StressField    stress;
    bool           with_stress_at_nodes;
    bool           with_stress_at_points;
  };
} // namespace corotet

#endif
