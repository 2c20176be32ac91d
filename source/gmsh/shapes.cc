// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "shapes.h"

#include <corotet/base/text.h>

#include <gmsh.h>

#include <cmath>
#include <cstdio>
#include <format>
#include <fstream>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sewing.h"

namespace corotet::gmsh_program
{
  namespace
  {
    using Entity = std::pair<int, int>;



    // The name of a shape in the file: the last part of "Assembly/Part/Solid".
    // Empty if it has no name.
    std::string
    name_of(const Entity &entity)
    {
      std::string name;
      gmsh::model::getEntityName(entity.first, entity.second, name);
      while (!name.empty() && (name.back() == '/' || name.back() == ' '))
        name.pop_back();
      return name.substr(name.find_last_of('/') + 1);
    }


    // The colour of a shape in the file as a word for parameter files,
    // "colour-ff8000"; empty if it has none.
    std::string
    colour_of(const Entity &entity)
    {
      int r = 0, g = 0, b = 0, opacity = 0;
      gmsh::model::getColor(entity.first, entity.second, r, g, b, opacity);
      if (opacity == 0)
        return "";
      char text[] = "colour-rrggbb";
      std::snprintf(
        text, sizeof(text), "colour-%02x%02x%02x", r & 255, g & 255, b & 255);
      return text;
    }



    // The colours of entities; empty if all entities have the same one.
    std::map<Entity, std::string>
    colours(const int dimension)
    {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      std::map<Entity, std::string> result;
      std::set<std::string>         different;
      for (const Entity &entity : entities)
        {
          const std::string colour = colour_of(entity);
          different.insert(colour);
          if (!colour.empty())
            result[entity] = colour;
        }
      return different.size() > 1 ? result : std::map<Entity, std::string>();
    }



    // The names of solids, or the colours of those without a name.
    std::map<Entity, std::string>
    names_of_solids(const gmsh::vectorpair &solids)
    {
      std::map<Entity, std::string> names = colours(3);
      for (const Entity &solid : solids)
        if (const std::string name = name_of(solid); !name.empty())
          names[solid] = name;
      return names;
    }



    gmsh::vectorpair
    import_solids(const GmshRequest &request)
    {
      gmsh::vectorpair shapes, solids;
      gmsh::option::setNumber("Geometry.OCCImportLabels", 1);
      gmsh::model::occ::importShapes(request.path,
                                     shapes,
                                     true,
                                     request.format);
      gmsh::model::occ::synchronize();
      gmsh::model::getEntities(solids, 3);
      return solids;
    }



    void
    add(std::string &remark, const std::string &more)
    {
      remark += (remark.empty() ? "" : "; ") + more;
    }



    // Adds remarks about solids of a STEP file that OpenCASCADE could not read,
    // for example because a part is missing, and about surfaces. If the number
    // of solids is increased by copies, missing ones may go unnoticed.
    void
    remark_lost_shapes(const GmshRequest      &request,
                       const gmsh::vectorpair &solids,
                       std::string            &remark)
    {
      if (request.format != "step")
        return;
      std::ifstream file(request.path);
      std::size_t   n_solids = 0, n_surfaces = 0;
      const auto    has = [](const std::string &text, const char *const word) {
        const std::size_t place = text.find(word);
        return place != std::string::npos && place > 0 &&
               std::string("=( \n").find(text[place - 1]) != std::string::npos;
      };
      for (std::string entity; std::getline(file, entity, ';');)
        if (has(entity, "MANIFOLD_SOLID_BREP(") ||
            has(entity, "BREP_WITH_VOIDS(") || has(entity, "FACETED_BREP("))
          ++n_solids;
        else if (has(entity, "SHELL_BASED_SURFACE_MODEL("))
          ++n_surfaces;
      if (n_solids > solids.size())
        add(remark,
            "of " + std::to_string(n_solids) + " solids in the file " +
              std::to_string(solids.size()) +
              " could be read, the others are left out: is a part of them "
              "missing?");
      if (n_surfaces > 0)
        add(remark,
            "beside its solids the file has surfaces, which are left out: " +
              std::to_string(n_surfaces));
    }



    // Adds remarks about overlaps, which are cut from all solids but the first.
    void
    remark_overlaps(const gmsh::vectorpair              &solids,
                    const std::vector<gmsh::vectorpair> &parts,
                    const std::map<Entity, std::string> &names,
                    std::string                         &remark)
    {
      const auto name = [&](const std::size_t i) {
        const auto found = names.find(solids[i]);
        return found != names.end() ?
                 "'" + found->second + "'" :
                 "solid " + std::to_string(solids[i].second);
      };
      std::map<Entity, std::size_t>                         owners;
      std::map<std::pair<std::size_t, std::size_t>, double> overlaps;
      for (std::size_t i = 0; i < solids.size(); ++i)
        for (const Entity &part : parts[i])
          if (const auto [owner, is_new] = owners.emplace(part, i); !is_new)
            {
              double volume = 0;
              gmsh::model::occ::getMass(part.first, part.second, volume);
              overlaps[{owner->second, i}] += volume;
            }
      for (const auto &[pair, volume] : overlaps)
        {
          char text[32];
          std::snprintf(text, sizeof(text), "%.4g", volume);
          add(remark,
              name(pair.first) + " and " + name(pair.second) +
                " overlap: a volume of " + text + " is that of " +
                name(pair.first) + " alone");
        }
    }



    // Makes touching solids share faces. The parts of a solid that was cut
    // inherit its name.
    void
    glue(const gmsh::vectorpair        &solids,
         std::map<Entity, std::string> &names,
         std::string                   &remark)
    {
      gmsh::vectorpair              all;
      std::vector<gmsh::vectorpair> parts;
      gmsh::model::occ::fragment(solids, {}, all, parts);
      gmsh::model::occ::synchronize();
      remark_overlaps(solids, parts, names, remark);
      std::map<Entity, std::string> names_of_parts;
      for (std::size_t i = 0; i < solids.size(); ++i)
        if (const auto name = names.find(solids[i]); name != names.end())
          for (const Entity &part : parts[i])
            names_of_parts.emplace(part, name->second);
      names = names_of_parts;
    }



    bool
    is_between_solids(const Entity &surface)
    {
      std::vector<int> solids, curves;
      gmsh::model::getAdjacencies(2, surface.second, solids, curves);
      return solids.size() > 1;
    }



    // Adds a group of entities for each name. Surfaces between solids have a
    // group only if the file has a name for them.
    void
    add_groups(std::vector<GmshModel::Group>       &groups,
               const int                            dimension,
               const std::string                   &kind,
               const std::map<Entity, std::string> &names)
    {
      gmsh::vectorpair entities;
      gmsh::model::getEntities(entities, dimension);
      std::map<std::string, std::size_t> known;
      std::set<std::string>              of_file;
      for (const auto &[entity, name] : names)
        of_file.insert(name);
      const auto is_taken = [&](const std::string &name) {
        return of_file.contains(name);
      };
      for (const Entity &entity : entities)
        {
          const auto found = names.find(entity);
          if (dimension == 2 && found == names.end() &&
              is_between_solids(entity))
            continue;
          const std::string name =
            found == names.end() ?
              unused_name(kind + ' ' + std::to_string(entity.second),
                          is_taken) :
              found->second;
          const auto [place, is_new] = known.emplace(name, groups.size());
          if (is_new)
            groups.push_back({dimension, entity.second, name, {}});
          groups[place->second].entities.push_back(entity.second);
        }
    }



    // Refuses an element size in another unit than the file's, with which gmsh
    // would work until its time or memory ends.
    void
    check_element_size(const GmshRequest &request)
    {
      if (request.element_size == 0)
        return;
      gmsh::vectorpair solids;
      gmsh::model::getEntities(solids, 3);
      double volume = 0;
      for (const auto &[dimension, tag] : solids)
        {
          double of_solid = 0;
          gmsh::model::occ::getMass(dimension, tag, of_solid);
          volume += of_solid;
        }
      // The number of regular tetrahedra of this size; the number of real ones
      // differs by less than the factor.
      constexpr double factor = 4;
      const double     n =
        volume * 6 * std::sqrt(2.) / std::pow(request.element_size, 3);
      if (n < factor * static_cast<double>(request.max_n_cells))
        return;
      double x[6];
      gmsh::model::getBoundingBox(-1, -1, x[0], x[1], x[2], x[3], x[4], x[5]);
      const std::string refined =
        request.n_refinements == 0 ?
          "" :
          std::format(" before {} refinements", request.n_refinements);
      throw std::runtime_error(std::format(
        "edges of {:g} make some {:.0e} cells of a body of {:.3g} x {:.3g} x "
        "{:.3g}; {:.3g} are allowed{}. All of these lengths are in the unit "
        "of the file, which is a millimetre for STEP and IGES",
        request.element_size,
        n,
        x[3] - x[0],
        x[4] - x[1],
        x[5] - x[2],
        request.max_n_cells,
        refined));
    }
  } // namespace



  std::vector<GmshModel::Group>
  read_shapes(const GmshRequest &request, std::string &remark)
  {
    gmsh::vectorpair              solids = import_solids(request);
    std::map<Entity, std::string> names  = names_of_solids(solids);
    if (solids.empty())
      solids = sew_solids(request, remark);
    else
      remark_lost_shapes(request, solids, remark);
    if (solids.size() > 1)
      glue(solids, names, remark);
    check_element_size(request);
    std::vector<GmshModel::Group> groups;
    add_groups(groups, 3, "solid", names);
    // Gluing may have replaced surfaces. They have colours, but no names of
    // their own.
    add_groups(groups, 2, "surface", colours(2));

    // Cells are small where the surface is bent, and nowhere large.
    double x[6];
    gmsh::model::getBoundingBox(-1, -1, x[0], x[1], x[2], x[3], x[4], x[5]);
    const double diagonal = std::hypot(x[3] - x[0], x[4] - x[1], x[5] - x[2]);
    gmsh::option::setNumber("Mesh.MeshSizeFromCurvature", 12);
    gmsh::option::setNumber("Mesh.MeshSizeMax", diagonal / 20);
    gmsh::option::setNumber("Mesh.MeshSizeMin", diagonal / 2000);
    return groups;
  }
} // namespace corotet::gmsh_program
