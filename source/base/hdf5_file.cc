// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/hdf5_file.h>
#include <corotet/base/mpi.h>
#include <corotet/base/whole_file.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "hdf5_types.h"

namespace corotet
{
  namespace
  {
    // The data space of a table: two-dimensional, or one-dimensional for a
    // plain list.
    Hdf5Id
    table_space(const hsize_t n_rows, const hsize_t n_columns)
    {
      const std::array<hsize_t, 2> sizes{{n_rows, n_columns}};
      return Hdf5Id(
        H5Screate_simple(n_columns == 0 ? 1 : 2, sizes.data(), nullptr));
    }

    // The creation properties of files, groups and tables: without times of
    // creation, so that the same numbers make the same file.
    Hdf5Id
    creation_properties(const hid_t kind)
    {
      Hdf5Id properties(H5Pcreate(kind));
      H5Pset_obj_track_times(properties, false);
      return properties;
    }

    // Selects rows of a table.
    herr_t
    select_rows(const Hdf5Id &space,
                const hsize_t first,
                const hsize_t n_rows,
                const hsize_t n_columns)
    {
      if (n_rows == 0)
        return H5Sselect_none(space);
      const std::array<hsize_t, 2> start{{first, 0}};
      const std::array<hsize_t, 2> count{{n_rows, n_columns}};
      return H5Sselect_hyperslab(
        space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    }
  } // namespace

  Hdf5File::Hdf5File(const std::string &path, const MPI_Comm comm)
    : path(path)
    , comm(comm)
  {
    const std::string temporary = path + ".tmp";
    if (dealii::Utilities::MPI::this_mpi_process(comm) == 0)
      {
        const Hdf5Silence silence;
        const Hdf5Id      access = unlocked_access();
        // HDF5 1.10, which virtual tables need, makes groups smaller, too.
        check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110));
        file = Hdf5Id(H5Fcreate(temporary.c_str(),
                                H5F_ACC_TRUNC,
                                creation_properties(H5P_FILE_CREATE),
                                access));
        check(file);
      }
    // From here on the file exists, so all ranks can open it.
    good = dealii::Utilities::MPI::broadcast(comm, good, 0);
    if (good)
      {
        descriptor = open(temporary.c_str(), O_WRONLY | O_CLOEXEC);
        check(descriptor);
      }
  }

  Hdf5File::~Hdf5File()
  {
    if (descriptor >= 0)
      close(descriptor);
  }

  bool
  Hdf5File::check(const long long result)
  {
    if (result < 0)
      good = false;
    return result >= 0;
  }

  haddr_t
  Hdf5File::create_table(const std::string &name,
                         const hid_t        type,
                         const Hdf5Rows    &rows)
  {
    if (file < 0)
      return HADDR_UNDEF;
    const Hdf5Silence silence;
    const Hdf5Id      space = table_space(rows.n_global_rows, rows.n_columns);
    // Space in the file is allocated now and filled by write_bytes() only.
    const Hdf5Id creation = creation_properties(H5P_DATASET_CREATE);
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_EARLY));
    check(H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER));
    const Hdf5Id dataset(H5Dcreate2(
      file, name.c_str(), type, space, H5P_DEFAULT, creation, H5P_DEFAULT));
    if (!check(dataset))
      return HADDR_UNDEF;
    const haddr_t place = H5Dget_offset(dataset);
    if (rows.n_global_rows > 0)
      check(place == HADDR_UNDEF ? -1 : 0);
    return place;
  }

  void
  Hdf5File::create(const std::vector<NewTable> &tables)
  {
    std::vector<std::uint64_t> places;
    places.reserve(tables.size());
    for (const auto &[name, n_rows, n_columns] : tables)
      places.push_back(
        create_table(name, H5T_NATIVE_DOUBLE, {0, 0, n_rows, n_columns}));
    dealii::Utilities::MPI::broadcast(places.data(), places.size(), 0, comm);
    for (std::size_t i = 0; i < tables.size(); ++i)
      place_of_table[tables[i].name] = places[i];
  }

  void
  Hdf5File::write_bytes(const char *data, std::size_t size, haddr_t place)
  {
    while (size > 0)
      {
        const ssize_t written = pwrite(descriptor, data, size, place);
        if (written < 0 && errno == EINTR)
          continue;
        if (!check(written))
          return;
        data += written;
        size -= written;
        place += written;
      }
  }

  template <typename Number>
  void
  Hdf5File::write(const std::string &name,
                  const Number      *data,
                  const Hdf5Rows    &rows)
  {
    const auto    known = place_of_table.find(name);
    std::uint64_t place = HADDR_UNDEF;
    if (known != place_of_table.end())
      place = known->second;
    else
      {
        place = create_table(name, hdf5_type<Number>(), rows);
        MPI_Bcast(&place, 1, MPI_UINT64_T, 0, comm);
      }
    if (place == HADDR_UNDEF || descriptor < 0)
      return;
    const std::size_t row_size =
      sizeof(Number) * (rows.n_columns == 0 ? 1 : rows.n_columns);
    write_bytes(reinterpret_cast<const char *>(data),
                rows.n_rows * row_size,
                place + rows.first * row_size);
  }

  template <typename Number>
  void
  Hdf5File::write_from_root(const std::string         &name,
                            const std::vector<Number> &values,
                            const hsize_t              n_columns)
  {
    const hsize_t n_rows =
      values.size() / (n_columns == 0 ? hsize_t(1) : n_columns);
    const bool root = dealii::Utilities::MPI::this_mpi_process(comm) == 0;
    write(name, values.data(), {0, root ? n_rows : 0, n_rows, n_columns});
  }

  void
  Hdf5File::write_constant(const std::string &name,
                           const std::int64_t value,
                           const hsize_t      n_rows,
                           const hsize_t      n_columns)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    const Hdf5Id      creation = creation_properties(H5P_DATASET_CREATE);
    check(H5Pset_fill_value(creation, H5T_NATIVE_INT64, &value));
    // Rows that are never written have the fill value.
    check(H5Pset_alloc_time(creation, H5D_ALLOC_TIME_LATE));
    const Hdf5Id space = table_space(n_rows, n_columns);
    const Hdf5Id dataset(H5Dcreate2(file,
                                    name.c_str(),
                                    H5T_NATIVE_INT64,
                                    space,
                                    H5P_DEFAULT,
                                    creation,
                                    H5P_DEFAULT));
    check(dataset);
  }

  template <typename Number>
  void
  Hdf5File::write_virtual(const std::string           &name,
                          const std::string           &source,
                          const std::vector<Hdf5Part> &parts,
                          const hsize_t                n_columns)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    hsize_t           n_rows = 0;
    for (const Hdf5Part &part : parts)
      n_rows += part.n_rows;
    const Hdf5Id space    = table_space(n_rows, n_columns);
    const Hdf5Id creation = creation_properties(H5P_DATASET_CREATE);
    hsize_t      first    = 0;
    for (const Hdf5Part &part : parts)
      {
        const Hdf5Id part_space = table_space(part.n_rows, n_columns);
        check(select_rows(space, first, part.n_rows, n_columns));
        check(H5Pset_virtual(
          creation, space, part.file.c_str(), source.c_str(), part_space));
        first += part.n_rows;
      }
    H5Sselect_all(space);
    const Hdf5Id dataset(H5Dcreate2(file,
                                    name.c_str(),
                                    hdf5_type<Number>(),
                                    space,
                                    H5P_DEFAULT,
                                    creation,
                                    H5P_DEFAULT));
    check(dataset);
  }

  void
  Hdf5File::create_group(const std::string &name)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    const Hdf5Id      creation = creation_properties(H5P_GROUP_CREATE);
    const Hdf5Id      group(
      H5Gcreate2(file, name.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT));
    check(group);
  }

  void
  Hdf5File::link(const std::string &name, const std::string &target)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    check(H5Lcreate_hard(
      file, target.c_str(), file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT));
  }

  void
  Hdf5File::link(const std::string &name,
                 const std::string &file_name,
                 const std::string &target)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    check(H5Lcreate_external(file_name.c_str(),
                             target.c_str(),
                             file,
                             name.c_str(),
                             H5P_DEFAULT,
                             H5P_DEFAULT));
  }

  void
  Hdf5File::write_number_attribute(const std::string               &object,
                                   const std::string               &name,
                                   const std::vector<std::int64_t> &values)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    const hsize_t     size = values.size();
    const Hdf5Id      space(size == 1 ? H5Screate(H5S_SCALAR) :
                                   H5Screate_simple(1, &size, nullptr));
    const Hdf5Id      attribute(H5Acreate_by_name(file,
                                             object.c_str(),
                                             name.c_str(),
                                             H5T_NATIVE_INT64,
                                             space,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT));
    if (check(attribute))
      check(H5Awrite(attribute, H5T_NATIVE_INT64, values.data()));
  }

  void
  Hdf5File::write_text_attribute(const std::string &object,
                                 const std::string &name,
                                 const std::string &text)
  {
    if (file < 0)
      return;
    const Hdf5Silence silence;
    const Hdf5Id      type(H5Tcopy(H5T_C_S1));
    check(H5Tset_size(type, text.size()));
    check(H5Tset_strpad(type, H5T_STR_NULLPAD));
    const Hdf5Id space(H5Screate(H5S_SCALAR));
    const Hdf5Id attribute(H5Acreate_by_name(file,
                                             object.c_str(),
                                             name.c_str(),
                                             type,
                                             space,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT,
                                             H5P_DEFAULT));
    if (check(attribute))
      check(H5Awrite(attribute, type, text.data()));
  }

  void
  Hdf5File::finish(const bool durable)
  {
    if (file >= 0)
      {
        const Hdf5Silence silence;
        // Releases the identifier even if the last data cannot be written.
        check(H5Fclose(file.release()));
      }
    if (descriptor >= 0 && durable)
      check(fsync(descriptor));
    // Only close() may report that the disk is full.
    if (descriptor >= 0)
      check(close(std::exchange(descriptor, -1)));
    good = dealii::Utilities::MPI::min(good ? 1 : 0, comm) == 1;
    // At the end of the program HDF5 tries again to write what it could not:
    // its messages would follow the message of the program itself.
    if (!good)
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    on_root(comm, [&] {
      std::error_code error;
      if (good)
        std::filesystem::rename(path + ".tmp", path, error);
      const std::string folder =
        std::filesystem::path(path).parent_path().string();
      if (good && !error && (!durable || sync_to_disk(folder)))
        return;
      std::error_code ignored;
      std::filesystem::remove(path + ".tmp", ignored);
      throw MachineError(path + ": the file cannot be written" +
                         (error ? ": " + error.message() :
                                  " (is the disk full, or permission "
                                  "missing?)"));
    });
  }

  template void
  Hdf5File::write(const std::string &, const double *, const Hdf5Rows &);
  template void
  Hdf5File::write(const std::string &, const std::int32_t *, const Hdf5Rows &);
  template void
  Hdf5File::write(const std::string &, const std::int64_t *, const Hdf5Rows &);
  template void
  Hdf5File::write(const std::string &, const std::uint8_t *, const Hdf5Rows &);
  template void
  Hdf5File::write_from_root(const std::string &,
                            const std::vector<double> &,
                            const hsize_t);
  template void
  Hdf5File::write_from_root(const std::string &,
                            const std::vector<std::int64_t> &,
                            const hsize_t);
  template void
  Hdf5File::write_from_root(const std::string &,
                            const std::vector<std::uint8_t> &,
                            const hsize_t);
  template void
  Hdf5File::write_virtual<double>(const std::string &,
                                  const std::string &,
                                  const std::vector<Hdf5Part> &,
                                  const hsize_t);
  template void
  Hdf5File::write_virtual<std::int64_t>(const std::string &,
                                        const std::string &,
                                        const std::vector<Hdf5Part> &,
                                        const hsize_t);
} // namespace corotet
