// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_size_of_motion_h
#define corotet_simulation_size_of_motion_h

#include <corotet/operators/surface_matrix.h>
#include <corotet/simulation/body.h>

#include <vector>

namespace corotet
{
  /**
   * The size of a displacement that its errors are compared with: its root mean
   * square, weighted by mass, without the translation of what neither supports
   * nor springs hold, as that makes no difference to the motion. Parts with
   * common nodes are held together.
   *
   * @p body must outlive this object.
   */
  class SizeOfMotion
  {
  public:
    /// @p springs are all springs, null if there are none. Collective.
    SizeOfMotion(const Body &body, const SurfaceMatrix *springs);

    /// The size of @p u [m]. Collective.
    double
    operator()(const Vector &u) const;

  private:
    const Body &body;
    /// For each owned node the number of what moves freely with it; that of
    /// nodes that are held is the number of masses.
    std::vector<unsigned int> free_part;
    /// The sum of the nodal masses of each free part [kg].
    std::vector<double> masses;
  };
} // namespace corotet

#endif
