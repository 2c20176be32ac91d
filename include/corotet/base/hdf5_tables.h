// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_hdf5_tables_h
#define corotet_base_hdf5_tables_h

#include <corotet/base/hdf5_file.h>

#include <array>
#include <string>
#include <vector>

namespace corotet
{
  /**
   * The tables of an HDF5 file that a user provides, whatever program wrote it:
   * in any layout and number format that HDF5 converts. One rank reads on its
   * own; others may read the same file at the same time.
   */
  class Hdf5Tables
  {
  public:
    /// Throws an InputError if the file is not an HDF5 file.
    explicit Hdf5Tables(const std::string &path);

    /// The number of rows of a table with @p n_columns columns; 0 columns mean
    /// a plain list. Throws an InputError if there is no such table.
    hsize_t
    n_rows(const std::string &name, const hsize_t n_columns) const;

    /// Some rows of a table, as double, std::int64_t or std::uint8_t. Throws an
    /// InputError if there is no such table, or it cannot be read.
    template <typename Number>
    std::vector<Number>
    read(const std::string &name, const Hdf5Rows &rows) const;

  private:
    [[noreturn]] void
    refuse(const std::string &name, const std::string &what) const;

    Hdf5Id
    open(const std::string &name) const;

    std::string path;
    Hdf5Id      file;
  };
} // namespace corotet

#endif
