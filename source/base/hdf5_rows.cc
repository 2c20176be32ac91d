// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/hdf5_file.h>
#include <corotet/base/mpi.h>

#include <array>
#include <fstream>

namespace corotet
{
  std::vector<double>
  read_table(const std::string &path,
             const std::string &name,
             const Hdf5Rows    &rows,
             const MPI_Comm     comm)
  {
    const std::uint64_t place = from_root(comm, [&]() -> std::uint64_t {
      const Hdf5Silence silence;
      const Hdf5Id file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT));
      const Hdf5Id dataset(
        file < 0 ? H5I_INVALID_HID : H5Dopen2(file, name.c_str(), H5P_DEFAULT));
      const Hdf5Id space(dataset < 0 ? H5I_INVALID_HID : H5Dget_space(dataset));
      std::array<hsize_t, 2> sizes{{0, 0}};
      if (space < 0 || H5Sget_simple_extent_ndims(space) != 2 ||
          H5Sget_simple_extent_dims(space, sizes.data(), nullptr) < 0 ||
          sizes[0] != rows.n_global_rows || sizes[1] != rows.n_columns ||
          H5Dget_offset(dataset) == HADDR_UNDEF)
        throw MachineError(path + ": the table " + name + " cannot be read");
      return H5Dget_offset(dataset);
    });
    std::vector<double> numbers(rows.n_rows * rows.n_columns);
    on_all_ranks(comm, [&] {
      std::ifstream file(path, std::ios::binary);
      file.seekg(place + rows.first * rows.n_columns * sizeof(double));
      file.read(reinterpret_cast<char *>(numbers.data()),
                numbers.size() * sizeof(double));
      if (!file)
        throw MachineError(path + ": the table " + name + " cannot be read");
    });
    return numbers;
  }
} // namespace corotet
