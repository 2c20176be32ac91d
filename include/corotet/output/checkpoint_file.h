// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_output_checkpoint_file_h
#define corotet_output_checkpoint_file_h

#include <corotet/base/archive.h>
#include <corotet/base/hdf5_file.h>
#include <corotet/discretization/discretization.h>
#include <corotet/output/file_order.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>

namespace corotet
{
  /**
   * A checkpoint is two files: PATH.h5 has the vectors, in an order that is
   * the same on any number of ranks, and PATH.json all else: its version, the
   * parameters and numbers of the run, the mesh, size and checksum of both
   * files. PATH.json gets its name last: without it there is no checkpoint.
   */
  class CheckpointWriter : public Archive
  {
  public:
    /// @p order, of the nodes of @p discretization, must outlive this object.
    CheckpointWriter(const std::string    &path,
                     const Discretization &discretization,
                     const FileOrder      &order);

    bool
    is_reading() const override
    {
      return false;
    }

    using Archive::transfer;
    void
    transfer(const std::string &name, std::string &text) override;
    void
    transfer(const std::string &name, Vector &vector) override;

    /// Completes the checkpoint. @p parameters: the text of every entry.
    /// @p durable: it survives a loss of power. Throws MachineError.
    void
    finish(const nlohmann::ordered_json &parameters, const bool durable);

  private:
    std::string            path;
    const Discretization  &discretization;
    const FileOrder       &order;
    Hdf5File               file;
    nlohmann::ordered_json values;
  };

  /**
   * Reads a checkpoint, on any number of ranks.
   */
  class CheckpointReader : public Archive
  {
  public:
    /// Throws InputError that says what is wrong with the checkpoint if it is
    /// not just as it was written, or of another version, and MachineError if
    /// it cannot be read. @p order, of the nodes of @p discretization, must
    /// outlive this object. Collective.
    CheckpointReader(const std::string    &path,
                     const Discretization &discretization,
                     const FileOrder      &order);

    bool
    is_reading() const override
    {
      return true;
    }

    using Archive::transfer;
    void
    transfer(const std::string &name, std::string &text) override;
    void
    transfer(const std::string &name, Vector &vector) override;

    /// Throws InputError if the checkpoint is that of another mesh. Collective.
    void
    check_mesh() const;

    /// Of its files, without their endings.
    const std::string &
    base_path() const
    {
      return path;
    }

    /// Of the run that wrote it.
    const nlohmann::ordered_json &
    parameters() const
    {
      return content.at("parameters");
    }

  private:
    [[noreturn]] void
    fail(const std::string &problem) const;

    std::string            path;
    const Discretization  &discretization;
    const FileOrder       &order;
    nlohmann::ordered_json content;
  };
} // namespace corotet

#endif
