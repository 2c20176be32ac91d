// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_contact_surface_h
#define corotet_forces_contact_surface_h

#include <corotet/forces/force_kind.h>

#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The surface of a body, as contact needs it: its faces and what their
   * quadrature points weigh.
   */
  class ContactSurface
  {
  public:
    struct Face
    {
      /// A local cell, perhaps a ghost.
      unsigned int cell;
      unsigned int face;
      /// The size of the face, or the height of the cell above it if that is
      /// larger [m].
      double size;
      /**
       * The default stiffness of contact per area [N/m^3], 10 E / h with the
       * size h. Where a part of the body has a thickness t below h / 3, it
       * bends and is softer by the third power of t / h: then the stiffness is
       * less by (3 t / h)^3, as contact that is far stiffer than the body
       * closes and opens at single points, and Newton's method follows.
       */
      double stiffness;
    };

    /// Faces of one boundary in the order of SurfaceMatrix.
    struct Boundary
    {
      unsigned int id;
      std::size_t  first;
      std::size_t  n_faces;
    };

    /// The boundaries with the ids @p touching; all of the surface if there are
    /// none. @p context must outlive this object, but for its log. Collective.
    ContactSurface(const ForceContext           &context,
                   const std::set<unsigned int> &touching);

    /// The local nodes of a face, nodes_per_face() of them.
    const unsigned int *
    nodes_of(const std::size_t face) const
    {
      return &face_nodes[nodes_per_face() * face];
    }

    unsigned int
    nodes_per_face() const
    {
      return reference.face_nodes[0].size();
    }

    /// Areas of the points at rest [m^2], [face][point].
    double
    area(const std::size_t face, const unsigned int point) const
    {
      return areas[n_points * face + point];
    }

    /// The smallest and the largest default stiffness of a face on all ranks
    /// [N/m^3]. Collective.
    std::pair<double, double>
    range_of_stiffness() const;

    const Discretization   &discretization;
    const ReferenceElement &reference;
    const unsigned int      n_points;
    std::vector<Face>       faces;
    std::vector<Boundary>   boundaries;
    /// The local nodes of all faces, ascending.
    std::vector<unsigned int> nodes;

  private:
    void
    add(const BoundaryFace &face,
        const Elasticity   &elasticity,
        const double        thickness);

    /// [face][k].
    std::vector<unsigned int> face_nodes;
    std::vector<double>       areas;
  };
} // namespace corotet

#endif
