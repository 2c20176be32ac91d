// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_hdf5_mesh_description_h
#define corotet_mesh_hdf5_mesh_description_h

#include <corotet/mesh/mesh_names.h>

#include <nlohmann/json.hpp>

#include <string>

namespace corotet::hdf5_mesh
{
  /// The version of the files that are written, the only one that is read.
  constexpr int version = 1;

  /// Throws the InputError about an invalid file.
  [[noreturn]] void
  refuse(const std::string &path, const std::string &message);

  /// The names in the description of a mesh.
  nlohmann::json
  to_json(const NamedSets &named);

  /// The names of a description; refuses invalid ids, and sets of unknown ids.
  NamedSets
  from_json(const nlohmann::json &text, const std::string &path);
} // namespace corotet::hdf5_mesh

#endif
