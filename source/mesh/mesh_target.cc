// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh_target.h>
#include <corotet/mesh/msh_file.h>

#include <fmt/format.h>

#include <filesystem>
#include <fstream>

namespace corotet
{
  namespace
  {
    namespace fs = std::filesystem;



    bool
    is_for_gmsh(const std::string &path)
    {
      return fs::path(path).extension() == ".msh";
    }



    bool
    begins_with_mesh_format(const std::string &path)
    {
      std::string   word;
      std::ifstream file(path);
      file >> word;
      return word == "$MeshFormat";
    }
  } // namespace



  void
  check_mesh_target(const std::string &path, const std::string &origin)
  {
    if (!is_for_gmsh(path) && fs::path(path).extension() != ".h5")
      throw InputError("",
                       fmt::format("a mesh is written to a .msh or an .h5 "
                                   "file: found '{}'",
                                   shortened(path)));
    std::error_code   error;
    const std::string folder = fs::path(path).parent_path().string();
    if (!folder.empty() && !fs::is_directory(folder, error) &&
        error != std::errc::permission_denied)
      throw InputError("",
                       fmt::format("'{}' cannot be written: there is no folder "
                                   "'{}'; allowed is a name in a folder that "
                                   "is there",
                                   shortened(path),
                                   shortened(folder)));
    if (fs::equivalent(path, origin, error))
      throw InputError("",
                       fmt::format("'{}' is the file that is read; give "
                                   "another name",
                                   shortened(path)));
    if (fs::exists(path, error) &&
        !(fs::is_regular_file(path, error) &&
          (is_for_gmsh(path) ? begins_with_mesh_format(path) :
                               is_hdf5_mesh(path))))
      throw InputError("",
                       fmt::format("'{}' is there, and is no mesh of {}, which "
                                   "would be replaced",
                                   shortened(path),
                                   is_for_gmsh(path) ? "gmsh" : "corotet"));
  }



  void
  write_mesh(const std::string &path, const SerialMesh &mesh)
  {
    check_mesh_target(path, mesh.origin);
    if (is_for_gmsh(path))
      write_msh_file(path, mesh);
    else
      write_hdf5_mesh(path, mesh);
  }
} // namespace corotet
