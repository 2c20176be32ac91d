// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_parameter_file_h
#define corotet_base_parameter_file_h

#include <corotet/base/parameter_reader.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>
#include <nlohmann/json_fwd.hpp>

#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The parameters of a run: declared in handler(), then read from a file, then
   * overridden by what the command line says. It knows where each entry was
   * set.
   *
   * Declared names must not have a "/" or a "." in them. Everything that is
   * bound to the handler by add_parameter() must outlive the calls of read().
   */
  class ParameterFile
  {
  public:
    /// The handler that parameters are declared in and read from.
    dealii::ParameterHandler &
    handler()
    {
      return prm;
    }

    /**
     * Reads the .prm, .json or .xml file @p path, then applies @p overrides,
     * each of the form "Section/Subsection/Entry = value", in their order.
     * Throws InputError, with file and line in the message, if something is
     * misspelt, out of its range, or no statement at all.
     *
     * Rank 0 of @p comm reads the file, for all of them. Collective.
     */
    void
    read(const std::string              &path,
         const std::vector<std::string> &overrides,
         const MPI_Comm                  comm = MPI_COMM_SELF);

    /**
     * Where the entry or subsection "Section/Subsection/Entry" was last set:
     * "FILE:LINE", "FILE" if that is not known or it has its default value,
     * "--set" if it was overridden.
     */
    std::string
    location(const std::string &entry) const;

    /// Whether the file or the command line has set "Section/Subsection/Entry".
    bool
    is_set(const std::string &entry) const
    {
      return places.contains(entry);
    }

    /// All declared entries with their present values, as ParameterHandler
    /// prints them; parameter_listing.h has functions for its nodes.
    nlohmann::ordered_json
    tree() const;

    /// The text of every entry as used: one object per section.
    nlohmann::ordered_json
    values() const;

    /// The name of the file that was read, as given.
    const std::string &
    path() const
    {
      return file;
    }

    /// The folder of the file; names of files in it are relative to this
    /// folder.
    std::string
    folder() const;

    /// Lists all entries. @p style: "prm", "json", "markdown" or "schema".
    void
    print(std::ostream &out, const std::string &style) const;

    /**
     * Writes every entry as used to a .prm file. Reading that file reproduces
     * the run: names of files relative to folder() become relative to the
     * folder of the new file. Throws MachineError if it cannot be written, and
     * what check_effective() throws.
     */
    void
    write_effective(const std::string &path) const;

    /// Throws InputError if write_effective() could not write the new name of a
    /// file so that it can be read again: if a folder's name has a "#", say.
    void
    check_effective(const std::string &path) const;

  private:
    /// tree() with the names of files as they are in a file @p path.
    nlohmann::ordered_json
    entries_for(const std::string &path) const;

    void
    apply(const ParameterStatement     &statement,
          const nlohmann::ordered_json &declared);

    dealii::ParameterHandler           prm;
    std::string                        file;
    std::map<std::string, std::string> places;
  };
} // namespace corotet

#endif
