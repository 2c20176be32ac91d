// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/programs.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/gmsh_elements.h>
#include <corotet/mesh/gmsh_process.h>

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "program_failure.h"
#include "scratch_folder.h"

namespace corotet
{
  namespace
  {
    // A path that gmsh recognizes: gmsh knows many formats only by the ending
    // of the file's name. It is a link to the file with this ending, as long as
    // this object lives, or the file itself.
    class NamedInput
    {
    public:
      explicit NamedInput(const GmshRequest &request)
        : path(request.path)
      {
        if (request.extension.empty() ||
            std::filesystem::path(path).extension() == request.extension)
          return;
        folder.emplace();
        path = folder->path("mesh" + request.extension);
        std::filesystem::create_symlink(std::filesystem::absolute(request.path),
                                        path);
      }

      std::string path;

    private:
      std::optional<ScratchFolder> folder;
    };



    // @p text with @p name in place of each @p other.
    std::string
    with_name(std::string        text,
              const std::string &other,
              const std::string &name)
    {
      if (other != name)
        for (std::size_t i = text.find(other); i != std::string::npos;
             i             = text.find(other, i + name.size()))
          text.replace(i, other.size(), name);
      return text;
    }



    // Turns an error of gmsh, "'PATH', line N: TEXT" or another text, into
    // "PATH:N: TEXT" or "PATH: TEXT".
    std::string
    message_of_gmsh(const std::string &path, std::string text)
    {
      std::replace(text.begin(), text.end(), '\n', ' ');
      const std::string start = "'" + path + "', line ";
      if (!text.starts_with(start))
        return path + ": gmsh: " + text;
      const std::size_t colon = text.find(':', start.size());
      return path + ":" + text.substr(start.size(), colon - start.size()) +
             ": gmsh" + text.substr(std::min(colon, text.size()));
    }



    // The memory limit of the process [byte]: for a mesh in proportion to its
    // file, for a geometry the memory of the machine.
    std::uint64_t
    memory_limit(const std::string &path, const bool is_geometry)
    {
      if (is_geometry)
        return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
               sysconf(_SC_PAGESIZE);
      return 100'000'000 + 10 * std::filesystem::file_size(path);
    }



    bool
    have_all_nodes(const std::vector<GmshModel::Elements> &all,
                   const gmsh_elements::NodeNumbers       &n_nodes)
    {
      return std::all_of(all.begin(), all.end(), [&](const auto &elements) {
        const auto found = n_nodes.find(elements.type);
        return found != n_nodes.end() &&
               elements.nodes.size() % found->second == 0;
      });
    }



    // Whether related lists have the sizes and types that they must have.
    bool
    fits_together(const GmshModel &model)
    {
      const auto is_group = [](const GmshModel::Group &group) {
        return group.dimension >= 0 && group.dimension <= 3 && group.id >= 0;
      };
      const auto has_whole_nodes = [](const GmshModel::ElementType &type) {
        const auto found = gmsh_elements::tetrahedron_nodes.find(type.type);
        return found == gmsh_elements::tetrahedron_nodes.end() ||
               type.nodes.size() == 3 * found->second;
      };
      std::set<int> types;
      for (const GmshModel::ElementType &type : model.volume_types)
        types.insert(type.type);
      const auto is_announced = [&](const GmshModel::Elements &elements) {
        return types.contains(elements.type);
      };
      return std::all_of(model.groups.begin(), model.groups.end(), is_group) &&
             std::all_of(model.volume_types.begin(),
                         model.volume_types.end(),
                         has_whole_nodes) &&
             std::all_of(model.volumes.begin(),
                         model.volumes.end(),
                         is_announced) &&
             have_all_nodes(model.volumes, gmsh_elements::tetrahedron_nodes) &&
             have_all_nodes(model.surfaces, gmsh_elements::triangle_nodes) &&
             have_all_nodes(model.curves, gmsh_elements::line_nodes) &&
             have_all_nodes(model.points, gmsh_elements::point_nodes) &&
             model.coordinates.size() == 3 * model.node_tags.size();
    }



    [[noreturn]] void
    refuse_model(const std::string &path)
    {
      throw InputError("",
                       path + ": gmsh has handed back what is no mesh; is the "
                              "file damaged?");
    }
  } // namespace



  GmshModel
  model_of_bytes(const std::string_view bytes, const std::string &path)
  {
    GmshModel   model;
    BytesReader reader(bytes);
    try
      {
        transfer(reader, model);
      }
    catch (const std::out_of_range &)
      {
        refuse_model(path);
      }
    if (!reader.is_at_end() || !fits_together(model))
      refuse_model(path);
    return model;
  }



  GmshModel
  run_gmsh(const GmshRequest &request, const std::string &origin)
  {
    const std::string &blamed  = origin.empty() ? request.path : origin;
    const std::string  program = find_installed("libexec/corotet/corotet-gmsh");
    if (program.empty())
      throw MachineError(
        "libexec/corotet/corotet-gmsh, which reads meshes, is missing: it is "
        "sought above the running program, above the library, and above the "
        "first corotet in PATH");
    const std::string folder =
      std::filesystem::absolute(request.path).parent_path().string();
    const NamedInput input(request);
    const ProgramEnd end = run_for_output(
      program,
      {input.path,
       fmt::format("{}", request.element_size),
       std::to_string(request.degree),
       std::to_string(request.n_refinements),
       fmt::format("{}", request.max_n_cells),
       request.format == "geo" ? folder : input.path,
       std::to_string(memory_limit(request.path, request.is_geometry)),
       request.format,
       request.is_geometry ? "1" : "0",
       fmt::format("{}", request.feature_angle)},
      request.time_limit);
    if (end.has_exceeded || end.signal != 0 || end.status != 0 ||
        end.output.empty())
      refuse_end(
        end, "gmsh", blamed, request.time_limit, request.time_limit_entry);
    const GmshModel model = model_of_bytes(end.output, blamed);
    if (!model.error.empty())
      throw InputError(
        "",
        message_of_gmsh(blamed, with_name(model.error, input.path, blamed)));
    if (model.is_too_large)
      {
        std::size_t n_cells = 0;
        for (const GmshModel::ElementType &type : model.volume_types)
          n_cells += type.n_elements;
        check_number_of_cells(n_cells, request.n_refinements);
      }
    return model;
  }
} // namespace corotet
