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
    json names = json::array(), sets = json::object(), parts = json::array();
    for (const auto &[id, name] : named.names)
      names.push_back({id, name});
    for (const auto &[name, ids] : named.sets)
      sets[name] = ids;
    for (const auto &[id, ids] : named.parts)
      parts.push_back({id, ids});
    return {{"names", names}, {"sets", sets}, {"parts", parts}};
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
    const auto known_ids = [&](const json &ids, const std::string &set) {
      auto result = ids.get<std::vector<unsigned int>>();
      std::ranges::sort(result);
      for (const unsigned int id : result)
        if (!named.names.contains(id))
          refuse(path,
                 fmt::format("found the id {} in the set '{}', which is "
                             "not there",
                             id,
                             shortened(set)));
      return result;
    };
    for (const auto &[name, ids] : text.at("sets").items())
      named.sets[name] = known_ids(ids, name);
    // Files of earlier program versions have no parts.
    for (const json &entry : text.value("parts", json::array()))
      {
        const auto id   = entry.at(0).get<unsigned int>();
        named.parts[id] = known_ids(entry.at(1), std::to_string(id));
      }
    return named;
  }
} // namespace corotet::hdf5_mesh
