// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_file_mesh_h
#define corotet_mesh_file_mesh_h

#include <corotet/mesh/mesh_format.h>
#include <corotet/mesh/mesh_source.h>

#include <utility>

namespace corotet
{
  /**
   * A mesh from a file of any format in mesh_format.h, which is recognized by
   * the file's content: either a mesh, which is taken as it is, or a geometry,
   * which gmsh (https://gmsh.info) meshes in a process of its own
   * (source/gmsh).
   *
   * Named volumes of a file become regions and named surfaces boundaries. Cells
   * are tetrahedra of degree 1, 2 or 3; those whose nodes are off the straight
   * position become curved cells. Other cells are refused.
   */
  class FileMesh : public MeshSource
  {
  public:
    /// @p name is the name of the subsection with its parameters.
    explicit FileMesh(const std::string &name);

    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    SerialMesh
    create(const std::string &folder,
           const unsigned int n_refinements = 0) const override;

    /// Reads a file that `corotet mesh --out x.h5` has written; a null pointer
    /// for other files.
    std::shared_ptr<SpreadMesh>
    create_spread(const std::string &folder,
                  const MPI_Comm     comm) const override;

  private:
    /// The path of the file and its format. Throws InputError about either, or
    /// about a parameter that this format does not use.
    std::pair<std::string, const MeshFormatDescription &>
    checked_file(const std::string &folder) const;

    std::string  section;
    std::string  file;
    double       element_size    = 0;
    double       feature_angle   = 40;
    unsigned int geometry_degree = 1;
    double       time_limit      = 3600;
  };

  /**
   * The mesh that is in a file, or is made of its geometry, checked. Does the
   * same as FileMesh, with the same parameters. Throws what FileMesh throws.
   */
  SerialMesh
  read_mesh_file(const std::string &file,
                 const double       element_size,
                 const unsigned int geometry_degree,
                 const double       feature_angle);
} // namespace corotet

#endif
