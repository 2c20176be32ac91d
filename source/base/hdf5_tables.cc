// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/hdf5_tables.h>

#include <fmt/format.h>

#include <cstdint>
#include <type_traits>

#include "hdf5_types.h"

namespace corotet
{
  Hdf5Tables::Hdf5Tables(const std::string &path)
    : path(path)
  {
    const Hdf5Silence silence;
    file = Hdf5Id(H5Fopen(path.c_str(), H5F_ACC_RDONLY, unlocked_access()));
    if (file < 0)
      throw InputError("",
                       path + ": cannot be opened as a file of HDF5: is the "
                              "rest missing?");
  }



  void
  Hdf5Tables::refuse(const std::string &name, const std::string &what) const
  {
    throw InputError("",
                     fmt::format("{}: table '{}': {}: is the file damaged?",
                                 path,
                                 name,
                                 what));
  }



  Hdf5Id
  Hdf5Tables::open(const std::string &name) const
  {
    Hdf5Id dataset(H5Dopen2(file, name.c_str(), H5P_DEFAULT));
    if (dataset < 0)
      refuse(name, "there is none");
    return dataset;
  }



  hsize_t
  Hdf5Tables::n_rows(const std::string &name, const hsize_t n_columns) const
  {
    const Hdf5Silence      silence;
    const Hdf5Id           dataset = open(name);
    const Hdf5Id           space(H5Dget_space(dataset));
    const int              n_dimensions = n_columns == 0 ? 1 : 2;
    std::array<hsize_t, 2> sizes{{0, 0}};
    if (H5Sget_simple_extent_ndims(space) != n_dimensions ||
        H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0 ||
        sizes[1] != n_columns)
      refuse(name,
             n_columns == 0 ?
               "found more than one dimension" :
               fmt::format("found other than {} columns", n_columns));
    // The limit is more than any machine has; products of it with numbers of
    // bytes do not overflow.
    if (sizes[0] > hsize_t(1) << 40)
      refuse(name, fmt::format("found {} rows", sizes[0]));
    return sizes[0];
  }



  template <typename Number>
  std::vector<Number>
  Hdf5Tables::read(const std::string &name, const Hdf5Rows &rows) const
  {
    const Hdf5Silence silence;
    const Hdf5Id      dataset = open(name);
    const Hdf5Id      type(H5Dget_type(dataset));
    const H5T_class_t wanted =
      std::is_same_v<Number, double> ? H5T_FLOAT : H5T_INTEGER;
    if (H5Tget_class(type) != wanted)
      refuse(name, "found other numbers than are allowed");
    std::vector<Number> numbers(rows.n_rows *
                                (rows.n_columns == 0 ? 1 : rows.n_columns));
    if (numbers.empty())
      return numbers;
    const std::array<hsize_t, 2> begin{{rows.first, 0}};
    const std::array<hsize_t, 2> size{{rows.n_rows, rows.n_columns}};
    const int                    n_dimensions = rows.n_columns == 0 ? 1 : 2;
    const Hdf5Id                 in_file(H5Dget_space(dataset));
    const Hdf5Id                 in_memory(
      H5Screate_simple(n_dimensions, size.data(), nullptr));
    if (H5Sselect_hyperslab(in_file,
                            H5S_SELECT_SET,
                            begin.data(),
                            nullptr,
                            size.data(),
                            nullptr) < 0 ||
        H5Dread(dataset,
                hdf5_type<Number>(),
                in_memory,
                in_file,
                H5P_DEFAULT,
                numbers.data()) < 0)
      refuse(name, "cannot be read");
    return numbers;
  }



  template std::vector<double>
  Hdf5Tables::read(const std::string &, const Hdf5Rows &) const;
  template std::vector<std::int64_t>
  Hdf5Tables::read(const std::string &, const Hdf5Rows &) const;
  template std::vector<std::uint8_t>
  Hdf5Tables::read(const std::string &, const Hdf5Rows &) const;
} // namespace corotet
