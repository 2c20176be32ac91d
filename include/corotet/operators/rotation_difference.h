// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_rotation_difference_h
#define corotet_operators_rotation_difference_h

#include <corotet/base/vector.h>
#include <corotet/discretization/discretization.h>

namespace corotet
{
  /// Largest angle between the rotation at a point of the stiffness rule and
  /// that at the centre of its cell [rad], for the displacement @p u, whose
  /// ghost entries must be up to date. Collective.
  double
  largest_rotation_difference(const Discretization   &discretization,
                              const ReferenceElement &reference,
                              const Vector           &u);
} // namespace corotet

#endif
