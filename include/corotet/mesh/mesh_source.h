// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_mesh_source_h
#define corotet_mesh_mesh_source_h

#include <corotet/mesh/serial_mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <mpi.h>

#include <memory>

namespace corotet
{
  struct SpreadMesh;

  /**
   * The source of a mesh: a generator or a file reader with its parameters.
   */
  class MeshSource
  {
  public:
    virtual ~MeshSource() = default;

    virtual void
    declare_parameters(dealii::ParameterHandler &prm) = 0;

    /**
     * The mesh, with coordinates as the source has them. Called on one rank
     * only, so it must not communicate. Relative file names are relative to @p
     * folder, the folder of the parameter file. A source that knows the
     * geometry makes the uniform refinements by itself, with new vertices on
     * the geometry, and says so in SerialMesh::n_refinements; others make none.
     * Throws InputError.
     */
    virtual SerialMesh
    create(const std::string &folder,
           const unsigned int n_refinements = 0) const = 0;

    /**
     * The unrefined mesh, made by all ranks together, each a part of it; a null
     * pointer if only one rank can make the mesh. Throws InputError.
     * Collective.
     */
    virtual std::shared_ptr<SpreadMesh>
    create_spread(const std::string & /*folder*/, const MPI_Comm /*comm*/) const
    {
      return nullptr;
    }
  };
} // namespace corotet

#endif
