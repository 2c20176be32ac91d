// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh.h>

namespace corotet
{
  MeshNames::MeshNames(const std::string                         &kind,
                       const std::map<unsigned int, std::string> &names)
    : kind(kind)
    , names(names)
  {}



  std::string
  MeshNames::name(const unsigned int id) const
  {
    const auto found = names.find(id);
    return found == names.end() || found->second.empty() ? std::to_string(id) :
                                                           found->second;
  }



  unsigned int
  MeshNames::id(const std::string &name_or_id, const std::string &entry) const
  {
    for (const auto &[id, name] : names)
      if (!name.empty() && name == name_or_id)
        return id;
    for (const auto &[id, name] : names)
      if (std::to_string(id) == name_or_id)
        return id;

    std::vector<std::string> known;
    for (const auto &[id, name] : names)
      known.push_back(this->name(id));
    const std::string plural  = kind == "boundary" ? "boundaries" : kind + "s";
    const std::string similar = nearest(name_or_id, known);
    throw InputError(entry,
                     "no such " + kind + ": found '" + shortened(name_or_id) +
                       "'; the mesh has " +
                       (known.empty() ? "no " + plural :
                                        "the " + plural + ": " + join(known)) +
                       (similar.empty() ? "" :
                                          "; did you mean '" + similar + "'?"));
  }
} // namespace corotet
