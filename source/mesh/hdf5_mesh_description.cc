// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "hdf5_mesh_description.h"

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace corotet::hdf5_mesh
{
  using nlohmann::json;

  void
  refuse(const std::string &path, const std::string &message)
  {
    throw InputError("", path + ": " + message + ": is the file damaged?");
  }



  json
  to_json(const NamedSets &named)
  {
    json names = json::array(), sets = json::object();
    for (const auto &[id, name] : named.names)
      names.push_back({id, name});
    for (const auto &[name, ids] : named.sets)
      sets[name] = ids;
    return {{"names", names}, {"sets", sets}};
  }



  NamedSets
  from_json(const json &text, const std::string &path)
  {
    NamedSets named;
    for (const json &entry : text.at("names"))
      {
        const auto id = entry.at(0).get<std::uint64_t>();
        if (id >= unnamed_boundary)
          refuse(path,
                 fmt::format("found the id {} of a name; 0 to {} are allowed",
                             id,
                             unnamed_boundary - 1));
        named.names[static_cast<unsigned int>(id)] =
          entry.at(1).get<std::string>();
      }
    for (const auto &[name, ids] : text.at("sets").items())
      {
        auto &of_set = named.sets[name];
        of_set       = ids.get<std::vector<unsigned int>>();
        std::ranges::sort(of_set);
        for (const unsigned int id : of_set)
          if (!named.names.contains(id))
            refuse(path,
                   fmt::format("found the id {} in the set '{}', which is "
                               "not there",
                               id,
                               shortened(name)));
      }
    return named;
  }
} // namespace corotet::hdf5_mesh
