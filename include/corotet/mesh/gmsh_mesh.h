// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_gmsh_mesh_h
#define corotet_mesh_gmsh_mesh_h

#include <corotet/mesh/gmsh_model.h>
#include <corotet/mesh/mesh_source.h>

namespace corotet
{
  /**
   * A mesh that gmsh reads (.msh 2.2 or 4.1, ASCII or binary) or makes (.geo),
   * https://gmsh.info, in a process of its own (source/gmsh): whatever the file
   * contains, it ends there, and can do no harm (check_gmsh_file.h).
   *
   * Physical volumes become regions and physical surfaces boundaries, with
   * gmsh's names and ids. Without any physical volume all cells belong to
   * region 0; if there are some, tetrahedra outside of them are left out with a
   * remark, as gmsh does when it writes a file. Nodes that no element uses are
   * dropped. Tetrahedra have 4, 10 or 20 nodes; those whose nodes are off the
   * straight position become curved cells. Other cells are refused.
   */
  class GmshMesh : public MeshSource
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    SerialMesh
    create(const std::string &folder,
           const unsigned int n_refinements = 0) const override;

  private:
    std::string  file;
    double       element_size    = 0;
    unsigned int geometry_degree = 1;
    double       time_limit      = 3600;
  };

  /**
   * The mesh that a model, whose parts fit together, consists of. Throws
   * InputError that blames the file @p path if it has other cells than
   * tetrahedra of one degree, entities of two groups or nodes without
   * coordinates. @p has_geometry: gmsh knows which of its surfaces are curved.
   */
  SerialMesh
  mesh_of_model(const GmshModel   &model,
                const std::string &path,
                const bool         has_geometry);
} // namespace corotet

#endif
