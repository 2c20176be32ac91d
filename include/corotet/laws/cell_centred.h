// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_cell_centred_h
#define corotet_laws_cell_centred_h

#include <corotet/material/material_law.h>

#include <memory>

namespace corotet
{
  /// Corotational elasticity with the rotation of each cell's centre; if
  /// @p variational, the force is the gradient of the energy. @p at_points is
  /// the law with a rotation for each point.
  std::shared_ptr<const MaterialLaw>
  cell_centred_law(const bool                                variational,
                   const std::shared_ptr<const MaterialLaw> &at_points);
} // namespace corotet

#endif
