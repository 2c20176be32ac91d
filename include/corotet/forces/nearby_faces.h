// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_nearby_faces_h
#define corotet_forces_nearby_faces_h

#include <corotet/forces/contact_surface.h>
#include <corotet/forces/obstacle.h>

#include <vector>

namespace corotet
{
  /**
   * The faces of a surface that may touch an obstacle, as a list that serves
   * until a node has moved so far relative to the obstacle that another face
   * could [verlet1967].
   *
   * The arguments of the constructor must outlive this object.
   */
  class NearbyFaces
  {
  public:
    NearbyFaces(const ContactSurface &surface, const Obstacle &obstacle);

    /// The faces that may have a point in the obstacle when the body is
    /// displaced by @p u, with ghosts, and the obstacle by @p moved [m]; their
    /// numbers in ContactSurface::faces, ascending.
    const std::vector<unsigned int> &
    find(const Vector &u, const dealii::Tensor<1, 3> &moved);

  private:
    /// How far nodes are from where they were at the last search, relative to
    /// the obstacle, at most [m].
    double
    motion_since(const Vector &u, const dealii::Tensor<1, 3> &moved) const;
    /// A distance by which all nodes of a face may move before a point of it
    /// can be in the obstacle [m]; negative if one may be there now.
    double
    slack(const std::size_t           face,
          const Vector               &u,
          const dealii::Tensor<1, 3> &moved) const;
    void
    search(const Vector &u, const dealii::Tensor<1, 3> &moved);

    const ContactSurface &surface;
    const Obstacle       &obstacle;
    /// The displacements of the surface's nodes at the last search [m].
    std::vector<dealii::Tensor<1, 3>> last_u;
    dealii::Tensor<1, 3>              last_moved;
    /// Motion for which the list serves [m]; negative before the first search.
    double                    skin = -1;
    std::vector<unsigned int> list;
    /// Work space of search().
    std::vector<double> slacks;
    /// A tenth of the mean size of faces [m].
    double least_skin = 0;
  };
} // namespace corotet

#endif
