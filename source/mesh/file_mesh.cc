// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/mesh/abaqus_file.h>
#include <corotet/mesh/check_gmsh_file.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/gmsh_process.h>
#include <corotet/mesh/mesh_format.h>

#include <fmt/format.h>

#include <filesystem>

namespace corotet
{
  namespace
  {
    void
    check_existence(const std::string &path, const std::string &entry)
    {
      std::error_code error;
      const bool      is_file = std::filesystem::is_regular_file(path, error);
      if (error && error != std::errc::no_such_file_or_directory)
        throw InputError(entry, shortened(path) + ": " + error.message());
      if (!is_file)
        throw InputError(entry,
                         "there is no mesh file: found '" + shortened(path) +
                           "'");
    }



    // What gmsh reads or makes of it.
    SerialMesh
    mesh_by_gmsh(const GmshRequest &request)
    {
      const GmshModel model = run_gmsh(request);
      if (model.is_too_large)
        {
          std::size_t n_cells = 0;
          for (const GmshModel::ElementType &type : model.volume_types)
            n_cells += type.n_elements;
          check_number_of_cells(n_cells, request.n_refinements);
        }
      SerialMesh mesh = mesh_of_model(model, request.path, request.is_geometry);
      if (request.is_geometry)
        mesh.n_refinements = request.n_refinements;
      return mesh;
    }
  } // namespace



  FileMesh::FileMesh(const std::string &name)
    : section("Mesh/" + name + "/")
  {}



  void
  FileMesh::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter(
      "File",
      file,
      "A mesh or a geometry, relative to the folder of this file: of gmsh "
      "(.msh, version 2.2 to 4.1, ASCII or binary; .geo), Abaqus or CalculiX "
      "(.inp), Nastran (.bdf), UNV, VTK (legacy), Medit or CGNS, or STEP, IGES "
      "and BREP of CAD programs. The format is known by the content.",
      dealii::Patterns::FileName());
    prm.add_parameter("Element size",
                      element_size,
                      "Target length of edges for a geometry [m, before "
                      "scaling]; 0 leaves it to a .geo, and to the curvature "
                      "and size of others. A mesh needs 0.",
                      dealii::Patterns::Double(0));
    prm.add_parameter(
      "Geometry degree",
      geometry_degree,
      "Degree of the cells' maps for a geometry [-]: 1 for straight "
      "cells, 2 or 3 for curved ones along curved surfaces. A mesh has that of "
      "its cells, and needs 1 here. Elements of a lower degree interpolate the "
      "geometry.",
      dealii::Patterns::Integer(1, 3));
    prm.add_parameter("Time limit",
                      time_limit,
                      "What gmsh may take to read or to mesh the file [s].",
                      dealii::Patterns::Double(1, 1e9));
  }



  SerialMesh
  FileMesh::create(const std::string &folder,
                   const unsigned int n_refinements) const
  {
    const std::string entry = section + "File";
    if (file.empty())
      throw InputError(entry,
                       "no mesh file: found an empty name; give the name of a "
                       ".msh or .geo file, say");
    const std::string path =
      (std::filesystem::path(folder) / file).lexically_normal().string();
    check_existence(path, entry);
    const MeshFormatDescription &format = mesh_format(path, entry);
    if (format.format == MeshFormat::msh)
      check_msh(path);
    else if (format.format == MeshFormat::geo)
      check_geo(path);
    else
      check_end(path, format.format);
    if (element_size > 0 && !format.is_geometry)
      throw InputError(section + "Element size",
                       fmt::format("only a geometry can be given an element "
                                   "size: found {} for the mesh '{}'; 0 is "
                                   "allowed",
                                   element_size,
                                   path));
    if (geometry_degree > 1 && !format.is_geometry)
      throw InputError(section + "Geometry degree",
                       fmt::format("a mesh has the degree of its cells: found "
                                   "{} for '{}'; 1 is allowed",
                                   geometry_degree,
                                   path));
    if (format.format == MeshFormat::abaqus)
      return serial_mesh(read_abaqus_file(path));

    GmshRequest request;
    request.path   = path;
    request.format = format.name;
    if (!format.is_geometry && format.format != MeshFormat::msh)
      request.extension =
        format.extensions.substr(0, format.extensions.find(','));
    request.is_geometry      = format.is_geometry;
    request.element_size     = element_size;
    request.degree           = geometry_degree;
    request.n_refinements    = format.is_geometry ? n_refinements : 0;
    request.max_n_cells      = largest_number_of_cells(request.n_refinements);
    request.time_limit       = time_limit;
    request.time_limit_entry = section + "Time limit";
    return mesh_by_gmsh(request);
  }



  SerialMesh
  read_mesh_file(const std::string &file,
                 const double       element_size,
                 const unsigned int geometry_degree)
  {
    FileMesh                 source("file");
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("File", file);
    prm.set("Element size", element_size);
    prm.set("Geometry degree", static_cast<long int>(geometry_degree));
    try
      {
        SerialMesh mesh = source.create("");
        check_mesh(mesh);
        return mesh;
      }
    catch (const InputError &error)
      {
        // There is no parameter file that could be blamed.
        throw InputError("", error.what());
      }
  }
} // namespace corotet
