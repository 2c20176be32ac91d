// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_hdf5_file_h
#define corotet_base_hdf5_file_h

#include <hdf5.h>
#include <mpi.h>

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The rows of a table that one rank holds: @p n_rows from row @p first of @p
   * n_global_rows, with @p n_columns numbers each; 0 columns make a plain
   * (one-dimensional) list. Ranks' rows do not overlap.
   */
  struct Hdf5Rows
  {
    hsize_t first;
    hsize_t n_rows;
    hsize_t n_global_rows;
    hsize_t n_columns = 0;
  };

  /**
   * Owns an HDF5 identifier of any kind. Where closing may fail, take the
   * identifier by release() and close it.
   */
  class Hdf5Id
  {
  public:
    Hdf5Id() = default;

    explicit Hdf5Id(const hid_t id)
      : id(id)
    {}

    Hdf5Id(Hdf5Id &&other) noexcept
      : id(std::exchange(other.id, H5I_INVALID_HID))
    {}

    Hdf5Id &
    operator=(Hdf5Id &&other) noexcept
    {
      std::swap(id, other.id);
      return *this;
    }

    Hdf5Id(const Hdf5Id &) = delete;
    Hdf5Id &
    operator=(const Hdf5Id &) = delete;

    ~Hdf5Id()
    {
      if (id >= 0)
        H5Idec_ref(id);
    }

    operator hid_t() const
    {
      return id;
    }

    /// Gives up the ownership of the identifier.
    hid_t
    release()
    {
      return std::exchange(id, H5I_INVALID_HID);
    }

  private:
    hid_t id = H5I_INVALID_HID;
  };

  /// Properties for opening files without locks, which some file systems of
  /// clusters refuse: no file is open for writing when others read it.
  inline Hdf5Id
  unlocked_access()
  {
    Hdf5Id access(H5Pcreate(H5P_FILE_ACCESS));
    H5Pset_file_locking(access, false, true);
    return access;
  }

  /**
   * Keeps HDF5 from printing its error stack during its lifetime: an Error
   * tells the user.
   */
  class Hdf5Silence
  {
  public:
    Hdf5Silence()
    {
      H5Eget_auto2(H5E_DEFAULT, &function, &data);
      H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }

    ~Hdf5Silence()
    {
      H5Eset_auto2(H5E_DEFAULT, function, data);
    }

    Hdf5Silence(const Hdf5Silence &) = delete;
    Hdf5Silence &
    operator=(const Hdf5Silence &) = delete;

  private:
    H5E_auto2_t function = nullptr;
    void       *data     = nullptr;
  };

  /**
   * A part of a virtual table: all @p n_rows rows of a table in @p file, a path
   * relative to the folder of the file that has the virtual table, or "." for
   * that file.
   */
  struct Hdf5Part
  {
    std::string file;
    hsize_t     n_rows;
  };

  /**
   * An HDF5 file that is written once, by all ranks of a communicator
   * together.
   *
   * Rank 0 creates the file and the tables, as in a program of one rank; each
   * rank writes its own rows to where the tables lie in the file (contiguously,
   * in the processor's own number format). Without MPI-IO, no rank waits for
   * the writing of another one.
   *
   * The file gets its name when it is complete: until then it is called
   * PATH.tmp. So whatever happens, PATH is whole or absent (or, where it
   * existed before, the old one).
   *
   * Errors (disk full, no permission) are noted and are thrown by finish().
   * deal.II's HDF5 interface checks for them in debug mode only, and lacks 8
   * and 64 bit integers.
   */
  class Hdf5File
  {
  public:
    /// Creates the file. Collective.
    Hdf5File(const std::string &path, const MPI_Comm comm);
    ~Hdf5File();

    Hdf5File(const Hdf5File &) = delete;
    Hdf5File &
    operator=(const Hdf5File &) = delete;

    /// A table of double to be created; with 0 columns, a plain list.
    struct NewTable
    {
      std::string name;
      hsize_t     n_rows;
      hsize_t     n_columns;
    };

    /// Creates several tables with one message for all of them; write() of
    /// these tables then needs no message. Collective.
    void
    create(const std::vector<NewTable> &tables);

    /**
     * Writes a table; @p data are the rows of this rank. Types: double,
     * std::int32_t, std::int64_t, std::uint8_t. A name with slashes needs its
     * group. Collective.
     */
    template <typename Number>
    void
    write(const std::string &name, const Number *data, const Hdf5Rows &rows);

    /// Writes a table that rank 0 gives; the other ranks' @p values are not
    /// read. All of them have the same size. Collective.
    template <typename Number>
    void
    write_from_root(const std::string         &name,
                    const std::vector<Number> &values,
                    const hsize_t              n_columns = 0);

    /// Writes a table that has the same number everywhere and, whatever its
    /// size, takes no space. Only rank 0 acts; the other ranks may call it.
    void
    write_constant(const std::string &name,
                   const std::int64_t value,
                   const hsize_t      n_rows,
                   const hsize_t      n_columns = 0);

    /**
     * Writes a table of double or std::int64_t that concatenates the rows of
     * the tables called @p source in other files (an HDF5 virtual dataset): the
     * numbers stay there. @p n_columns is the same in all of them. Costs some
     * 30 microseconds per part. Only rank 0 acts; the other ranks may call it.
     */
    template <typename Number>
    void
    write_virtual(const std::string           &name,
                  const std::string           &source,
                  const std::vector<Hdf5Part> &parts,
                  const hsize_t                n_columns);

    /// Creates a group. Only rank 0 acts; the other ranks may call it.
    void
    create_group(const std::string &name);

    /// Gives the table @p target of this file the additional name @p name. Only
    /// rank 0 acts; the other ranks may call it.
    void
    link(const std::string &name, const std::string &target);

    /// Makes @p name a link to @p target in @p file, a path relative to this
    /// file's folder. Only rank 0 acts; the other ranks may call it.
    void
    link(const std::string &name,
         const std::string &file,
         const std::string &target);

    /// Writes the attribute @p name of @p object. Only rank 0 acts; the other
    /// ranks may call it.
    void
    write_number_attribute(const std::string               &object,
                           const std::string               &name,
                           const std::vector<std::int64_t> &values);

    /// Writes an attribute that is a text. Only rank 0 acts; the other ranks
    /// may call it.
    void
    write_text_attribute(const std::string &object,
                         const std::string &name,
                         const std::string &text);

    /// Closes the file and gives it its name. @p durable: on return the file is
    /// on the disk and survives a loss of power. Throws MachineError on all
    /// ranks if anything went wrong on any rank. Collective.
    void
    finish(const bool durable = false);

  private:
    /// Notes a failure; returns whether @p result is good.
    bool
    check(const long long result);

    /// Creates a table on rank 0. Returns the position in the file where its
    /// data begin [byte]; HADDR_UNDEF if it has none, because the table is
    /// empty or there was an error.
    haddr_t
    create_table(const std::string &name,
                 const hid_t        type,
                 const Hdf5Rows    &rows);

    /// Writes bytes of this rank to the position @p place of the file.
    void
    write_bytes(const char *data, std::size_t size, haddr_t place);

    std::string path;
    MPI_Comm    comm;
    bool        good = true;
    /// The file, open on rank 0 only.
    Hdf5Id file;
    /// The descriptor of the file, on each rank; -1 if it is not open.
    int descriptor = -1;
    /// The positions returned by create_table(), of tables that create() has
    /// made.
    std::map<std::string, std::uint64_t> place_of_table;
  };
} // namespace corotet

#endif
