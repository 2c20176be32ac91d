// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/mesh/mesh_names.h>

#include <algorithm>
#include <set>

namespace corotet
{
  namespace
  {
    bool
    contains(const std::vector<unsigned int> &ids, const unsigned int id)
    {
      return std::binary_search(ids.begin(), ids.end(), id);
    }
  } // namespace



  std::vector<unsigned int>
  NamedSets::ids(const std::string &name) const
  {
    if (const auto found = sets.find(name); found != sets.end())
      return found->second;
    for (const auto &[id, own] : names)
      if (!name.empty() && own == name)
        return {id};
    return {};
  }



  void
  NamedSets::add(const std::string                 &name,
                 std::vector<std::size_t>           members,
                 const std::vector<unsigned int *> &id_of_member)
  {
    // Files may name members more than once.
    std::ranges::sort(members);
    members.erase(std::unique(members.begin(), members.end()), members.end());
    std::map<unsigned int, std::uint64_t> n_in_set;
    for (const std::size_t member : members)
      ++n_in_set[*id_of_member[member]];
    // Counts all members by the ids in this set; other ids are skipped, as
    // there are many members and sets.
    std::vector<IdCount> counts;
    for (const auto &[id, n] : n_in_set)
      counts.push_back({id, 0, n});
    unsigned int first_free = 0;
    for (const unsigned int *id : id_of_member)
      {
        first_free = std::max(first_free, *id + 1);
        const auto count =
          std::ranges::lower_bound(counts, *id, {}, &IdCount::id);
        if (count != counts.end() && count->id == *id)
          ++count->n_members;
      }
    const auto part_of = add(name, counts, first_free);
    for (const std::size_t member : members)
      if (const auto part = part_of.find(*id_of_member[member]);
          part != part_of.end())
        *id_of_member[member] = part->second;
  }



  std::map<unsigned int, unsigned int>
  NamedSets::add(const std::string          &name,
                 const std::vector<IdCount> &counts,
                 const unsigned int          first_free)
  {
    unsigned int next = first_free;
    for (const auto &[id, own] : names)
      next = std::max(next, id + 1);

    const std::vector<unsigned int>      before = ids(name);
    std::set<unsigned int>               meant(before.begin(), before.end());
    std::map<unsigned int, unsigned int> part_of;
    for (const auto &[id, n_members, n_in_set] : counts)
      {
        if (n_in_set == n_members || meant.contains(id))
          {
            meant.insert(id);
            continue;
          }
        const unsigned int part = next++;
        part_of[id]             = part;
        meant.insert(part);
        for (auto &[other, ids] : sets)
          if (contains(ids, id))
            ids.push_back(part);
        // Other ids exist only because an id was split: their numbers have no
        // meaning.
        if (names.contains(id))
          parts.try_emplace(id, 1, id);
        for (auto &[whole, ids] : parts)
          if (contains(ids, id))
            ids.push_back(part);
        if (const auto own = names.find(id);
            own != names.end() && !own->second.empty())
          {
            sets[own->second] = {id, part};
            own->second.clear();
          }
      }
    for (auto &[id, own] : names)
      if (own == name)
        own.clear();
    sets[name].assign(meant.begin(), meant.end());
    return part_of;
  }



  void
  NamedSets::restrict_to(const std::vector<unsigned int> &used)
  {
    const std::set<unsigned int> kept(used.begin(), used.end());
    std::erase_if(names,
                  [&](const auto &own) { return kept.count(own.first) == 0; });
    for (auto &[name, ids] : sets)
      std::erase_if(ids,
                    [&](const unsigned int id) { return !kept.contains(id); });
    std::erase_if(sets, [](const auto &set) { return set.second.empty(); });
    for (auto &[whole, ids] : parts)
      std::erase_if(ids,
                    [&](const unsigned int id) { return !kept.contains(id); });
    std::erase_if(parts, [](const auto &part) { return part.second.empty(); });
    for (const unsigned int id : kept)
      names.emplace(id, "");
  }



  MeshNames::MeshNames(const std::string &kind, const NamedSets &named)
    : kind(kind)
    , named(named)
  {}



  std::string
  MeshNames::name(const unsigned int id) const
  {
    const auto found = named.names.find(id);
    if (found != named.names.end() && !found->second.empty())
      return found->second;
    std::vector<std::string> words;
    for (const auto &[name, ids] : named.sets)
      if (contains(ids, id))
        words.push_back(name);
    return words.empty() ? std::to_string(id) : join(words, " & ");
  }



  std::string
  MeshNames::name(const std::vector<unsigned int> &ids) const
  {
    for (const auto &[name, of_name] : named.sets)
      if (of_name == ids)
        return name;
    for (const auto &[id, of_id] : named.parts)
      if (of_id == ids)
        return std::to_string(id);
    std::vector<std::string> words;
    for (const unsigned int id : ids)
      words.push_back(name(id));
    return join(words);
  }



  std::vector<std::string>
  MeshNames::known() const
  {
    std::vector<std::string> result;
    std::set<unsigned int>   in_union;
    for (const auto &[name, ids] : named.sets)
      in_union.insert(ids.begin(), ids.end());
    for (const auto &[id, own] : named.names)
      if (!own.empty())
        result.push_back(own);
      else if (!in_union.contains(id))
        result.push_back(std::to_string(id));
    for (const auto &[name, ids] : named.sets)
      result.push_back(name);
    return result;
  }



  std::vector<std::pair<std::string, std::vector<unsigned int>>>
  MeshNames::known_with_ids() const
  {
    std::map<std::string, std::vector<unsigned int>> meaning = named.sets;
    for (const auto &[id, own] : named.names)
      if (!own.empty())
        meaning.emplace(own, std::vector{id});
    for (const auto &[id, own] : named.names)
      meaning.emplace(std::to_string(id), of_number(id));
    std::vector<std::pair<std::string, std::vector<unsigned int>>> result;
    for (const std::string &name : known())
      result.emplace_back(name, meaning.at(name));
    return result;
  }



  std::vector<unsigned int>
  MeshNames::of_number(const unsigned int id) const
  {
    const auto found = named.parts.find(id);
    return found != named.parts.end() ? found->second : std::vector{id};
  }



  std::vector<unsigned int>
  MeshNames::find(const std::string &name_or_id) const
  {
    if (const std::vector<unsigned int> found = named.ids(name_or_id);
        !found.empty())
      return found;
    for (const auto &[id, own] : named.names)
      if (std::to_string(id) == name_or_id)
        return of_number(id);
    for (const auto &[id, of_id] : named.parts)
      if (std::to_string(id) == name_or_id)
        return of_id;
    return named.ids(without_quotes(name_or_id));
  }



  std::string
  MeshNames::listed() const
  {
    const std::string names  = list_of_names(known());
    const std::string plural = kind == "boundary" ? "boundaries" : kind + "s";
    return names.empty() ? "no " + plural : "the " + plural + ": " + names;
  }



  std::vector<unsigned int>
  MeshNames::ids(const std::string &name_or_id, const std::string &entry) const
  {
    std::vector<unsigned int> found = find(name_or_id);
    if (found.empty())
      refuse(name_or_id, entry, {this});
    return found;
  }



  void
  MeshNames::refuse(const std::string                    &name_or_id,
                    const std::string                    &entry,
                    const std::vector<const MeshNames *> &all)
  {
    std::string              kinds, lists;
    std::vector<std::string> known;
    for (std::size_t i = 0; i < all.size(); ++i)
      {
        if (i > 0)
          kinds += i + 1 < all.size() ? ", " : " or ";
        kinds += all[i]->kind;
        lists += (i == 0 ? "" : "; ") + all[i]->listed();
        for (const std::string &name : all[i]->known())
          known.push_back(name);
      }
    const std::string similar = nearest(name_or_id, known);
    throw InputError(entry,
                     "no such " + kinds + ": found '" + shortened(name_or_id) +
                       "'; the mesh has " + lists +
                       (similar.empty() ? "" :
                                          "; did you mean '" + similar + "'?"));
  }



  PlaceNames::PlaceNames(const NamedSets &boundaries,
                         const NamedSets &edges,
                         const NamedSets &corners)
    : boundaries("boundary", boundaries)
    , edges("edge", edges)
    , corners("corner", corners)
  {}



  Place
  PlaceNames::find(const std::string &name_or_id,
                   const std::string &entry) const
  {
    for (const std::string &name : {name_or_id, without_quotes(name_or_id)})
      if (const Place place{boundaries.find_name(name),
                            edges.find_name(name),
                            corners.find_name(name)};
          place != Place())
        return place;
    Place place;
    for (const auto &[names, ids] : {std::pair(&boundaries, &place.boundaries),
                                     std::pair(&edges, &place.edges),
                                     std::pair(&corners, &place.corners)})
      if (*ids = names->find(name_or_id); !ids->empty())
        return place;
    std::vector<const MeshNames *> all{&boundaries};
    for (const MeshNames *names : {&edges, &corners})
      if (!names->known().empty())
        all.push_back(names);
    MeshNames::refuse(name_or_id, entry, all);
  }



  std::vector<unsigned int>
  PlaceNames::boundary_ids(const std::string &name_or_id,
                           const std::string &entry,
                           const std::string &what) const
  {
    std::vector<unsigned int> found = boundaries.find(name_or_id);
    if (!found.empty())
      return found;
    for (const auto &[names, kind] :
         {std::pair(&edges, "an edge"), std::pair(&corners, "a corner")})
      if (!names->find(name_or_id).empty())
        throw InputError(entry,
                         what + " acts on an area: found '" +
                           shortened(name_or_id) + "', which is " + kind +
                           "; allowed are boundaries, and the mesh has " +
                           boundaries.listed());
    return boundaries.ids(name_or_id, entry);
  }



  std::string
  PlaceNames::name(const Place &place) const
  {
    std::vector<std::string> words;
    for (const auto &[names, ids] : {std::pair(&boundaries, &place.boundaries),
                                     std::pair(&edges, &place.edges),
                                     std::pair(&corners, &place.corners)})
      if (!ids->empty())
        if (const std::string name = names->name(*ids);
            std::find(words.begin(), words.end(), name) == words.end())
          words.push_back(name);
    return join(words);
  }



  std::string
  PlaceNames::kind(const Place &place)
  {
    const bool has_boundaries = !place.boundaries.empty();
    const bool has_edges      = !place.edges.empty();
    const bool has_corners    = !place.corners.empty();
    if (has_boundaries ? has_edges || has_corners : has_edges && has_corners)
      return "place";
    if (has_boundaries)
      return "boundary";
    return has_edges ? "edge" : "corner";
  }
} // namespace corotet
