// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_tangent_h
#define corotet_operators_tangent_h

#include <corotet/base/enumeration.h>

namespace corotet
{
  /// The derivative of the internal force.
  enum class Tangent
  {
    /// With frozen rotations, as if they did not depend on the displacement:
    /// symmetric and positive semi-definite.
    frozen_rotation,
    /// The exact derivative.
    consistent
  };

  inline const Enumeration<Tangent> tangents{
    {"consistent", Tangent::consistent},
    {"frozen rotation", Tangent::frozen_rotation}};
} // namespace corotet

#endif
