// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_mesh_tools_h
#define corotet_tests_mesh_tools_h

#include <corotet/base/exceptions.h>
#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/mesh_quality.h>

#include <gmsh.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "../refusal.h"
#include "../serial_meshes.h"
#include "../source_path.h"
#include "../temporary_folder.h"

namespace corotet::tests
{
  /// The generated box of 2 x 0.5 x 1 with so many cuboids.
  inline SerialMesh
  box_of_2_by_half_by_1(const std::string &cells)
  {
    BoxMesh                  source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("Size", "2, 0.5, 1");
    prm.set("Cells", cells);
    return source.create("");
  }

  inline SerialMesh
  read_gmsh(const std::string &file,
            const std::string &folder        = "",
            const std::string &element_size  = "0",
            const std::string &degree        = "1",
            const unsigned int n_refinements = 0)
  {
    GmshMesh                 source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("File", file);
    prm.set("Element size", element_size);
    prm.set("Geometry degree", degree);
    return source.create(folder, n_refinements);
  }

  /// The checked mesh of a mesh or geometry file of any format.
  inline SerialMesh
  read_file(const std::string &file,
            const std::string &element_size = "0",
            const std::string &degree       = "1")
  {
    FileMesh                 source("file");
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("File", file);
    prm.set("Element size", element_size);
    prm.set("Geometry degree", degree);
    SerialMesh mesh = source.create("");
    check_mesh(mesh);
    return mesh;
  }

  /// Lets gmsh write the shapes that @p make adds to a file.
  inline void
  write_shapes(const std::string &file, const std::function<void()> &make)
  {
    gmsh::initialize(0, nullptr, false, false);
    gmsh::option::setNumber("General.Terminal", 0);
    make();
    gmsh::model::occ::synchronize();
    gmsh::write(file);
    gmsh::finalize();
  }

  /// Within write_shapes(): boxes of 1 x 1 x 1 and 2 x 1 x 1 that share a face,
  /// solids 1 and 2.
  inline void
  add_two_boxes()
  {
    namespace occ = gmsh::model::occ;
    occ::addBox(0, 0, 0, 1, 1, 1, 1);
    occ::addBox(1, 0, 0, 2, 1, 1, 2);
    gmsh::vectorpair              all;
    std::vector<gmsh::vectorpair> parts;
    occ::fragment({{3, 1}}, {{3, 2}}, all, parts);
    occ::synchronize();
  }

  /// Within write_shapes(): cuts a solid out of another one, by their numbers.
  inline void
  cut_solid(const int solid, const int tool)
  {
    gmsh::vectorpair              result;
    std::vector<gmsh::vectorpair> parts;
    gmsh::model::occ::cut({{3, solid}}, {{3, tool}}, result, parts);
  }

  inline double
  total(const std::map<unsigned int, double> &values)
  {
    double sum = 0;
    for (const auto &[id, value] : values)
      sum += value;
    return sum;
  }

  /// Sum of the areas of the listed faces of each boundary.
  inline std::map<unsigned int, double>
  boundary_areas(const SerialMesh &mesh)
  {
    std::map<unsigned int, double> areas;
    for (const SerialMesh::Face &face : mesh.faces)
      {
        const auto &p = mesh.vertices[face.vertices[0]];
        areas[face.boundary] +=
          dealii::cross_product_3d(mesh.vertices[face.vertices[1]] - p,
                                   mesh.vertices[face.vertices[2]] - p)
            .norm() /
          2;
      }
    return areas;
  }

  /// The sum of the values of all ids that a name means.
  inline double
  value_of(const std::string                    &name,
           const std::string                    &kind,
           const NamedSets                      &named,
           const std::map<unsigned int, double> &values)
  {
    double sum = 0;
    for (const unsigned int id : MeshNames(kind, named).ids(name, ""))
      sum += values.at(id);
    return sum;
  }

  /// Volume of each region.
  inline std::map<unsigned int, double>
  region_volumes(const SerialMesh &mesh)
  {
    std::map<unsigned int, double> volumes;
    for (const SerialMesh::Cell &cell : mesh.cells)
      volumes[cell.region] += signed_volume(cell_vertices(mesh, cell));
    return volumes;
  }

  /// Sum of the areas of the faces that a name means.
  inline double
  area(const SerialMesh &mesh, const std::string &name)
  {
    return value_of(name, "boundary", mesh.boundaries, boundary_areas(mesh));
  }

  /// Volume of the cells that a name means.
  inline double
  volume(const SerialMesh &mesh, const std::string &name)
  {
    return value_of(name, "region", mesh.regions, region_volumes(mesh));
  }
} // namespace corotet::tests

#endif
