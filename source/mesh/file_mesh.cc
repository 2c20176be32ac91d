// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/file_names.h>
#include <corotet/base/mpi.h>
#include <corotet/base/text.h>
#include <corotet/mesh/abaqus_file.h>
#include <corotet/mesh/check_gmsh_file.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/file_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/gmsh_process.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh_readers.h>
#include <corotet/mesh/spread_mesh.h>
#include <corotet/mesh/surface_mesh.h>
#include <corotet/mesh/vtk_file.h>

#include <fmt/format.h>

#include <filesystem>

#include "scratch_folder.h"

namespace corotet
{
  namespace
  {
    void
    check_existence(const std::string &path, const std::string &entry)
    {
      std::error_code error;
      const bool      is_file = std::filesystem::is_regular_file(path, error);
      if (error == std::errc::permission_denied)
        throw MachineError(shortened(path) + ": cannot be read (permission?)");
      if (error && error != std::errc::no_such_file_or_directory)
        throw InputError(entry, shortened(path) + ": " + error.message());
      if (!is_file)
        throw InputError(entry,
                         "there is no mesh file: found '" + shortened(path) +
                           "'");
    }



    // The model in a VTK file, which a script converts first.
    GmshModel
    model_by_vtk(const GmshRequest &request)
    {
      const ScratchFolder folder;
      const std::string   converted = folder.path("mesh.msh");
      const std::string   remark    = write_msh_of_vtk_file(
        request.path, converted, request.time_limit, request.time_limit_entry);
      GmshModel model = read_msh_2(converted, true, request.path);
      model.remark    = remark;
      return model;
    }



    // The model in a file, read by our own readers or, for other formats, by
    // gmsh. @p version is that of a gmsh file.
    GmshModel
    model_of_file(const GmshRequest &request,
                  const MeshFormat   format,
                  const double       version)
    {
      if (format == MeshFormat::vtk)
        return model_by_vtk(request);
      if (format == MeshFormat::nastran)
        return read_nastran(request.path);
      if (format == MeshFormat::unv)
        return read_unv(request.path);
      if (format == MeshFormat::msh && version < 3)
        return read_msh_2(request.path);
      if (format == MeshFormat::medit)
        return read_medit(request.path);
      return run_gmsh(request);
    }



    // Throws an InputError if a parameter is given that the format does not
    // use.
    void
    check_use(const bool         is_used,
              const std::string &entry,
              const std::string &path,
              const double       value,
              const double       unused,
              const std::string &reason)
    {
      if (!is_used && value != unused)
        throw InputError(entry,
                         fmt::format("{}: found {} for '{}'; {} is allowed",
                                     reason,
                                     value,
                                     path,
                                     unused));
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
      "Name of the file with a mesh or a geometry, relative to the folder of "
      "this file. Meshes: gmsh (.msh, version 2.2 to 4.1, ASCII or binary), "
      "Abaqus or CalculiX (.inp), Nastran (.bdf), UNV, VTK (.vtk, .vtu), "
      "Medit, MED, CGNS, or what 'corotet mesh --out' has written (.h5). "
      "Geometries, which gmsh meshes: gmsh (.geo), CAD programs (STEP, IGES, "
      "BREP), or a closed surface of triangles (STL, PLY, OBJ, OFF). The "
      "format is recognized by the content, or else by the ending of the "
      "name.",
      dealii::Patterns::FileName());
    prm.add_parameter(
      "Element size",
      element_size,
      "Target length of the edges of cells that are made for a geometry, in "
      "the unit of the file (STEP and IGES: mm). 0: a .geo has its own sizes, "
      "a surface keeps its triangles, and for other geometries the length "
      "follows the curvature and is at most a twentieth of the body's "
      "diagonal. A mesh allows 0 only.",
      dealii::Patterns::Double(0));
    prm.add_parameter("Feature angle",
                      feature_angle,
                      "Angle between the normals of neighbouring triangles "
                      "above which a surface of triangles (STL, PLY, OBJ, OFF) "
                      "has an edge [degree]. Edges separate boundaries, and "
                      "are kept when the surface gets new triangles by "
                      "'Element size'.",
                      dealii::Patterns::Double(1, 180));
    prm.add_parameter(
      "Geometry degree",
      geometry_degree,
      "Polynomial degree of the shape of cells that are made for a geometry "
      "[-]: 1, straight cells; 2 or 3, cells that are curved along curved "
      "surfaces. Elements of a lower degree use shapes interpolated to their "
      "own degree. A mesh, whose cells have a degree already, and a surface of "
      "triangles allow 1 only.",
      dealii::Patterns::Integer(1, 3));
    prm.add_parameter("Time limit",
                      time_limit,
                      "Longest wall time that gmsh, or VTK for its own files, "
                      "may take to read or mesh the file [s]. If it takes "
                      "longer, the run ends with an error.",
                      dealii::Patterns::Double(1, 1e9));
  }



  std::pair<std::string, const MeshFormatDescription &>
  FileMesh::checked_file(const std::string &folder) const
  {
    const std::string entry = section + "File";
    if (file.empty())
      throw InputError(entry,
                       "no mesh file: found an empty name; give the name of a "
                       ".msh or .geo file, say");
    const std::string path = file_in(folder, file);
    check_existence(path, entry);
    const MeshFormatDescription &format = mesh_format(path, entry);
    check_use(format.is_geometry,
              section + "Element size",
              path,
              element_size,
              0,
              "only a geometry can be given an element size");
    check_use(format.is_geometry,
              section + "Geometry degree",
              path,
              geometry_degree,
              1,
              "a mesh has the degree of its cells");
    check_use(!format.is_surface,
              section + "Geometry degree",
              path,
              geometry_degree,
              1,
              "cells inside of a surface of triangles are straight");
    return {path, format};
  }



  std::shared_ptr<SpreadMesh>
  FileMesh::create_spread(const std::string &folder, const MPI_Comm comm) const
  {
    const std::string path = from_root(comm, [&] {
      const auto [path, format] = checked_file(folder);
      return format.format == MeshFormat::corotet ? path : "";
    });
    if (path.empty())
      return nullptr;
    return std::make_shared<SpreadMesh>(read_hdf5_mesh(path, comm));
  }



  SerialMesh
  FileMesh::create(const std::string &folder,
                   const unsigned int n_refinements) const
  {
    const auto [path, format] = checked_file(folder);
    double version            = 0;
    if (format.format == MeshFormat::msh)
      version = check_msh(path);
    else if (format.format == MeshFormat::geo)
      check_geo(path);
    else
      check_end(path, format.format);
    if (format.format == MeshFormat::corotet)
      return read_hdf5_mesh(path);
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
    request.feature_angle    = feature_angle;
    SerialMesh mesh;
    if (format.is_surface)
      mesh = mesh_of_surface(request, format.format);
    else
      mesh = mesh_of_model(model_of_file(request, format.format, version),
                           path,
                           format.is_geometry);
    if (format.format == MeshFormat::step)
      if (const std::string unit = other_length_unit(path); !unit.empty())
        mesh.remarks.push_back("coordinates are in millimetre: those of the "
                               "file, in " +
                               printable(unit) + ", have been converted");
    mesh.is_in_millimetres =
      format.format == MeshFormat::step || format.format == MeshFormat::iges;
    mesh.n_refinements = request.n_refinements;
    return mesh;
  }



  SerialMesh
  read_mesh_file(const std::string &file,
                 const double       element_size,
                 const unsigned int geometry_degree,
                 const double       feature_angle)
  {
    FileMesh                 source("file");
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("File", file);
    prm.set("Element size", element_size);
    prm.set("Geometry degree", static_cast<long int>(geometry_degree));
    prm.set("Feature angle", feature_angle);
    try
      {
        SerialMesh mesh = source.create("");
        check_mesh(mesh);
        return mesh;
      }
    catch (const InputError &error)
      {
        // There is no parameter file to blame.
        throw InputError("", error.what());
      }
  }
} // namespace corotet
