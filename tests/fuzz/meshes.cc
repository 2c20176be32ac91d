// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Readers of mesh files, checks of files before gmsh reads them, and the reader
// of the bytes that gmsh's process hands back, whatever the file did to that
// process.

#include <corotet/base/log.h>
#include <corotet/mesh/abaqus_file.h>
#include <corotet/mesh/check_gmsh_file.h>
#include <corotet/mesh/check_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>
#include <corotet/mesh/gmsh_process.h>
#include <corotet/mesh/hdf5_mesh.h>
#include <corotet/mesh/mesh.h>
#include <corotet/mesh/mesh_format.h>
#include <corotet/mesh/mesh_readers.h>
#include <corotet/mesh/triangle_surface.h>

#include <mpi.h>

#include "targets.h"

namespace fuzz
{
  namespace
  {
    void
    use(const corotet::SerialMesh &mesh,
        const unsigned int         n_refinements,
        const unsigned int         degree)
    {
      if (mesh.cells.size() > 20)
        return;
      is_accepted([&] {
        corotet::Log        log(MPI_COMM_SELF, true);
        const corotet::Mesh whole(
          mesh, n_refinements, 1., MPI_COMM_SELF, log, degree);
      });
    }

    // Uses the mesh that a reader of corotet gives, if it does not refuse the
    // file.
    template <typename Read>
    void
    use_model(const std::string &path, const Read &read)
    {
      corotet::SerialMesh mesh;
      if (is_accepted(
            [&] { mesh = corotet::mesh_of_model(read(path), path, false); }))
        use(mesh, 0, 2);
    }
  } // namespace

  // Reads a .msh file of version 2; gmsh reads those of version 4.
  void
  read_mesh_file(const std::string &input)
  {
    const std::string path    = write("mesh.msh", input);
    double            version = 0;
    if (is_accepted([&] { version = corotet::check_msh(path); }) && version < 3)
      use_model(path, [&](const std::string &file) {
        return corotet::read_msh_2(file, input.size() % 2 == 1);
      });
  }

  void
  read_nastran_file(const std::string &input)
  {
    use_model(write("part.bdf", input), corotet::read_nastran);
  }

  void
  read_medit_file(const std::string &input)
  {
    use_model(write("part.mesh", input), corotet::read_medit);
  }

  void
  read_unv_file(const std::string &input)
  {
    use_model(write("part.unv", input), corotet::read_unv);
  }

  // Checks a geometry. Behind a line "//====" there is a second file, part.geo,
  // which the first may include.
  void
  read_geometry(const std::string &input)
  {
    const std::string mark = "\n//====\n";
    const std::size_t cut  = input.find(mark);
    write("part.geo",
          cut == std::string::npos ? "" : input.substr(cut + mark.size()));
    const std::string path = write("main.geo", input.substr(0, cut));
    is_accepted([&] { corotet::check_geo(path); });
  }

  // A mesh that is accepted must be usable. The first byte says whether the
  // mesh comes from a geometry, and for which elements it is to be used.
  void
  read_gmsh_model(const std::string &input)
  {
    if (input.empty())
      return;
    const unsigned int  first = static_cast<unsigned char>(input[0]);
    corotet::SerialMesh mesh;
    if (!is_accepted([&] {
          mesh = corotet::mesh_of_model(
            corotet::model_of_bytes(std::string_view(input).substr(1),
                                    "mesh.msh"),
            "mesh.msh",
            first % 2 == 1);
        }))
      return;
    use(mesh, first / 2 % 2, 1 + first / 4 % 3);
  }

  void
  read_abaqus_input(const std::string &input)
  {
    const std::string   path = write("part.inp", input);
    corotet::SerialMesh mesh;
    if (is_accepted([&] {
          mesh = corotet::serial_mesh(corotet::read_abaqus_file(path));
        }))
      use(mesh, 0, 2);
  }

  // Reads a mesh file of corotet as one rank reads it as a whole.
  void
  read_hdf5_file(const std::string &input)
  {
    const std::string   path = write("mesh.h5", input);
    corotet::SerialMesh mesh;
    if (is_accepted([&] { mesh = corotet::read_hdf5_mesh(path); }))
      use(mesh, 0, 2);
  }

  // An accepted closed surface must have two triangles at each edge, and all of
  // it must belong to bodies. Files of no other format are read as binary STL.
  void
  read_surface(const std::string &input)
  {
    const std::string path = write("surface", input);
    is_accepted([&] {
      const corotet::MeshFormatDescription format =
        corotet::mesh_format(path, "");
      corotet::TriangleSurface surface = corotet::read_triangle_file(
        path, format.is_surface ? format.format : corotet::MeshFormat::stl);
      corotet::mend_surface(surface);
      corotet::check_intersections(surface);
      const auto edges   = corotet::surface_edges(surface);
      const auto shells  = corotet::surface_shells(surface, edges);
      const auto patches = corotet::surface_patches(surface, edges, 40);
      if (2 * edges.size() != 3 * surface.triangles.size() ||
          shells.bodies.empty() || patches.size() != surface.triangles.size())
        std::abort();
    });
  }
} // namespace fuzz
