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
   * Writes a checkpoint, which consists of two files: PATH.h5 has the vectors,
   * in an order that is the same on any number of ranks, and PATH.json
   * everything else: the version, the parameters and numbers of the run, the
   * mesh, size and checksum of both files. PATH.json gets its name last:
   * without it there is no checkpoint.
   */
  class CheckpointWriter : public Archive
  {
  public:
    /// @p order is that of the nodes of @p discretization and must outlive this
    /// object.
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

    /// Completes the checkpoint. @p parameters has the text of every entry. @p
    /// durable: the checkpoint survives a loss of power. Throws MachineError.
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
    /// Throws an InputError about the checkpoint if it is damaged or of another
    /// version, and MachineError if it cannot be read. @p order is that of the
    /// nodes of @p discretization and must outlive this object. Collective.
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

    /// Throws InputError if the checkpoint belongs to another mesh. Collective.
    void
    check_mesh() const;

    /// The path of the checkpoint's files, without their endings.
    const std::string &
    base_path() const
    {
      return path;
    }

    /// The parameters of the run that wrote the checkpoint.
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
