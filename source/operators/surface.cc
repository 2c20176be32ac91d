// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/surface.h>

#include <deal.II/base/mpi.h>

namespace corotet
{
  double
  local_displaced_volume(const Discretization   &discretization,
                         const ReferenceElement &reference,
                         const Vector           &u)
  {
    double volume = 0;
    for (const BoundaryFace &face : discretization.boundary_faces())
      for_each_surface_point(
        discretization, reference, face, &u, [&](const SurfacePoint &point) {
          volume += point.position * point.area / 3;
        });
    return volume;
  }

  double
  displaced_volume(const Discretization   &discretization,
                   const ReferenceElement &reference,
                   const Vector           &u)
  {
    return dealii::Utilities::MPI::sum(local_displaced_volume(discretization,
                                                              reference,
                                                              u),
                                       discretization.communicator());
  }
} // namespace corotet
