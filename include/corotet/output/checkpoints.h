// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_checkpoints_h
#define corotet_output_checkpoints_h

#include <corotet/base/log.h>
#include <corotet/output/checkpoint_file.h>
#include <corotet/simulation/simulation.h>

#include <deal.II/base/parameter_handler.h>

#include <nlohmann/json.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace corotet
{
  /**
   * The parameters of section Checkpoint.
   */
  struct CheckpointParameters
  {
    /// Declares the entries in the section that @p prm is in.
    void
    declare_parameters(dealii::ParameterHandler &prm);

    /// The number of steps between checkpoints; 0: no checkpoints by steps.
    unsigned int steps_between = 0;
    /// The wall time between checkpoints [min]; 0: no checkpoints by time.
    double       minutes_between = 10;
    unsigned int keep            = 2;
    /// The limit of wall time [s]; 0: no limit.
    double wall_time_limit = 0;

    bool
    are_written() const
    {
      return steps_between > 0 || minutes_between > 0;
    }
  };

  /// The reason why a run is to end before its time: a signal that StopSignals
  /// has received on any rank, or the limit of wall time. Empty if there is
  /// none. Collective.
  std::string
  reason_to_stop(const CheckpointParameters &parameters, const MPI_Comm comm);

  /**
   * An entry whose text has changed.
   */
  struct ChangedEntry
  {
    /// "Section/Entry".
    std::string entry;
    std::string now;
    std::string before;
  };

  /// The first changed entry with which a run that began with the entries @p
  /// before cannot continue, if there is one; both arguments have the text of
  /// every entry. The way to write numbers does not matter, nor do blanks
  /// around the items of lists, nor entries that only one of them has.
  std::optional<ChangedEntry>
  forbidden_change(const nlohmann::ordered_json &before,
                   const nlohmann::ordered_json &now);

  /**
   * The checkpoints of a run, in the folder checkpoint of its output directory:
   * when they are written, which are kept, and from which a run continues; also
   * whether it has to end before its time, because of a signal or the limit.
   *
   * All members are collective.
   */
  class Checkpoints
  {
  public:
    /// The checkpoints of a run that writes into @p directory, with its log in
    /// @p log_file. @p values has the text of every entry of the run. The
    /// arguments must outlive this object.
    Checkpoints(const CheckpointParameters   &parameters,
                const std::string            &directory,
                const std::string            &log_file,
                const nlohmann::ordered_json &values,
                const Body                   &body,
                Log                          &log);

    /// Whether there are any checkpoints, good or damaged.
    bool
    has_any() const;

    /// The newest good checkpoint; the log names those that are damaged. Null
    /// if there is none. Throws InputError if entries of the run, its mesh or
    /// its tables have changed where they must not, and MachineError if a
    /// checkpoint cannot be read.
    std::unique_ptr<CheckpointReader>
    newest() const;

    /// Makes @p simulation, which has not been started, and the log continue
    /// from @p checkpoint. Newer checkpoints, which are damaged, are removed.
    void
    resume(Simulation                                   &simulation,
           const std::vector<std::unique_ptr<Observer>> &observers,
           const OutputTimes                            &recording,
           CheckpointReader                             &checkpoint);

    /// Makes all steps of a run that has been started, and finishes it.
    /// Checkpoints are written when they are due, and at the end unless @p
    /// saves_end is false. Throws Stopped after the run was saved, if it had to
    /// end earlier.
    void
    run(Simulation &simulation, const bool saves_end = true);

  private:
    /// A state of the run, which also gives the name of its checkpoint's files.
    struct Place
    {
      /// The last step that was begun, and the number of its parts that are
      /// done, or 0 if all of it is done.
      unsigned int step;
      unsigned int parts;

      unsigned int
      last_whole_step() const
      {
        return parts == 0 ? step : step - 1;
      }

      bool
      operator==(const Place &) const = default;

      /// Whether this state comes before @p other.
      bool
      operator<(const Place &other) const
      {
        const auto key = [](const Place &place) {
          return std::tuple(place.step, place.parts == 0, place.parts);
        };
        return key(*this) < key(other);
      }

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive & step & parts;
      }
    };

    static Place
    place_of(const Simulation &simulation);
    /// The last whole step with a checkpoint; 0 if there is none.
    unsigned int
    last_whole_step_written() const
    {
      return written_place ? written_place->last_whole_step() : 0;
    }
    /// The text of a state in the log.
    static std::string
    in_words(const Place &place);
    /// The requests to the run, as bits, the same on all ranks.
    int
    requests();
    /// Whether the present step has to be given up, because a request to stop
    /// came some time ago. Known to this rank only.
    bool
    is_urgent() const;
    void
    write(Simulation &simulation, const bool durable);
    /// Removes the rest of checkpoints that were never finished. Called on rank
    /// 0 while none is being written.
    void
    remove_unfinished() const;
    /// Removes all checkpoints but the newest ones. Called on rank 0.
    void
    remove_old() const;
    /// The states of all checkpoints in the folder, the newest first. Called on
    /// rank 0.
    std::vector<Place>
    places() const;
    std::string
    path_of(const Place &place) const;
    /// The order of nodes in files, which is computed when the first checkpoint
    /// is read or written. Collective.
    const FileOrder &
    order_of_nodes() const;
    void
    check_entries(const CheckpointReader &checkpoint) const;
    void
    check_tables(CheckpointReader &checkpoint) const;

    using Clock = std::chrono::steady_clock;

    const CheckpointParameters   &parameters;
    std::string                   directory;
    std::string                   log_file;
    const nlohmann::ordered_json &values;
    const Body                   &body;
    const Discretization         &discretization;
    const MPI_Comm                comm;
    Log                          &log;
    /// See order_of_nodes().
    mutable std::optional<FileOrder> order;
    Clock::time_point                written = Clock::now();
    std::optional<Place>             written_place;
    /// Whether run() has made a step, or a part of one.
    bool has_advanced = false;
  };
} // namespace corotet

#endif
