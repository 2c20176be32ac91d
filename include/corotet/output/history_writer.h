// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_history_writer_h
#define corotet_output_history_writer_h

#include <corotet/output/probes.h>
#include <corotet/output/stress_probes.h>
#include <corotet/output/support_reactions.h>
#include <corotet/simulation/observer.h>
#include <corotet/simulation/simulation.h>

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * A row of the history: its columns by name, in order. @p displacements are
   * the displacements of the probes called @p names [m].
   */
  nlohmann::ordered_json
  history_row(const StepRecord                        &record,
              const std::vector<std::string>          &names,
              const std::vector<dealii::Tensor<1, 3>> &displacements);

  /// Adds the columns of the stress at the probes called @p names [Pa].
  void
  add_stress_columns(
    nlohmann::ordered_json                           &row,
    const std::vector<std::string>                   &names,
    const std::vector<dealii::SymmetricTensor<2, 3>> &stresses);

  /**
   * The objects with additional columns for a row of the history.
   */
  struct HistoryColumns
  {
    /// Has only the columns of probes.
    HistoryColumns(const Probes &probes)
      : probes(probes)
    {}

    /// Has all columns that @p parameters ask for.
    /// Throws InputError. Collective.
    HistoryColumns(const OutputParameters &parameters,
                   const Simulation       &simulation,
                   Log                    &log);

    /// The row of a state. Collective.
    nlohmann::ordered_json
    row(const Snapshot &state) const;

    Probes                      probes;
    std::optional<StressProbes> stress_probes;
    SupportReactions            reactions;
  };

  /**
   * A row as history.csv has it with these @p parameters and @p obstacles, for
   * a body at rest.
   */
  nlohmann::ordered_json
  history_example(const OutputParameters         &parameters,
                  const std::vector<std::string> &obstacles);

  /**
   * Writes history.csv: a row per step, step 0 included, each complete in the
   * file before the next step. Numbers have enough digits to read the same
   * double back. A value that is not a number is written as nan.
   */
  class HistoryWriter : public Observer
  {
  public:
    HistoryWriter(const std::string &directory, const HistoryColumns &columns);
    ~HistoryWriter() override;

    /// Opens the file. Throws MachineError if it cannot be written, as does
    /// step().
    void
    start(const Snapshot &initial) override;

    void
    transfer(Archive &archive) override;

    /// Removes the rows that were written after the checkpoint.
    void
    resume(const Snapshot &state) override;

    void
    step(const Snapshot &state) override;

    /// The last row, on all ranks; empty before start().
    const nlohmann::ordered_json &
    last_row() const
    {
      return *row;
    }

  private:
    /// Writes the row of @p state, which becomes the last one.
    void
    write_row(const Snapshot &state, const bool with_names);

    std::string    path;
    HistoryColumns columns;
    std::ofstream  file;
    /// The size of the file at the checkpoint [byte]; on rank 0.
    std::int64_t                            saved_size = 0;
    std::unique_ptr<nlohmann::ordered_json> row;
  };
} // namespace corotet

#endif
