// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_summary_writer_h
#define corotet_output_summary_writer_h

#include <corotet/output/history_writer.h>
#include <corotet/simulation/observer.h>

#include <optional>
#include <string>

namespace corotet
{
  /**
   * Writes summary.json when the run ends, also if it failed. The file is
   * complete or absent. A value that is not a number is written as null.
   *
   * @p history gives the last row; it must be called before this observer and
   * must outlive it. With @p with_error_estimate the summary has the estimated
   * error of the last state's stress.
   */
  class SummaryWriter : public Observer
  {
  public:
    SummaryWriter(const std::string   &directory,
                  const HistoryWriter &history,
                  const MPI_Comm       comm,
                  const bool           with_error_estimate = false);

    void
    resume(const Snapshot &state) override;

    void
    step(const Snapshot &state) override;

    void
    save(const Snapshot &state) override;

    /// Throws MachineError if the file cannot be written.
    void
    finish(const RunSummary &summary) override;

  private:
    std::string          directory;
    const HistoryWriter &history;
    MPI_Comm             comm;
    bool                 with_error_estimate;
    /// The estimated error of the last state's stress: |sigma* - sigma|_E
    /// [sqrt(J)], and relative.
    struct ErrorEstimate
    {
      double energy_norm;
      double relative;
    };
    std::optional<ErrorEstimate> error_estimate;
  };

  /**
   * Writes @p directory/summary.json: the entries that all runs have in common,
   * with the entries of @p results in the middle. Throws MachineError if the
   * file cannot be written. Collective.
   */
  void
  write_summary(const std::string            &directory,
                const RunSummary             &summary,
                const nlohmann::ordered_json &results,
                const MPI_Comm                comm);
} // namespace corotet

#endif
