// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_hdf5_types_h
#define corotet_base_hdf5_types_h

#include <hdf5.h>

#include <cstdint>
#include <type_traits>

namespace corotet
{
  /// HDF5's type of numbers in memory.
  template <typename Number>
  hid_t
  hdf5_type()
  {
    if constexpr (std::is_same_v<Number, double>)
      return H5T_NATIVE_DOUBLE;
    else if constexpr (std::is_same_v<Number, std::int64_t>)
      return H5T_NATIVE_INT64;
    else if constexpr (std::is_same_v<Number, std::int32_t>)
      return H5T_NATIVE_INT32;
    else
      {
        static_assert(std::is_same_v<Number, std::uint8_t>);
        return H5T_NATIVE_UINT8;
      }
  }
} // namespace corotet

#endif
