// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_mesh_box_mesh_h
#define corotet_mesh_box_mesh_h

#include <corotet/mesh/mesh_source.h>

#include <array>

namespace corotet
{
  struct MeshPart;

  /**
   * A box of cuboids, each cut into five tetrahedra: one in the middle (regular
   * if the cuboid is a cube) and one at every other corner. Neighbouring
   * cuboids are mirror images, so the mesh is conforming and prefers no
   * diagonal.
   *
   * The sides are the boundaries x-min, x-max, y-min, y-max, z-min, z-max with
   * the ids 0 to 5; the volume is the region body with the id 0.
   */
  class BoxMesh : public MeshSource
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    SerialMesh
    create(const std::string &folder,
           const unsigned int n_refinements = 0) const override;

    std::shared_ptr<SpreadMesh>
    create_spread(const std::string &folder,
                  const MPI_Comm     comm) const override;

  private:
    /// Throws InputError for wrong parameters, and MachineError if @p n_ranks
    /// ranks do not have the memory for the mesh.
    void
    check(const unsigned int n_ranks) const;

    /// The part of a rank: the sequence of cells is divided into one piece per
    /// rank, all of the same length.
    MeshPart
    piece(const unsigned int rank, const unsigned int n_ranks) const;

    std::array<double, 3>       origin  = {{0, 0, 0}};
    std::array<double, 3>       size    = {{1, 0.1, 0.1}};
    std::array<unsigned int, 3> n_cells = {{10, 1, 1}};
  };
} // namespace corotet

#endif
