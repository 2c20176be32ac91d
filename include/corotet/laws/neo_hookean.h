// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_neo_hookean_h
#define corotet_laws_neo_hookean_h

#include <corotet/material/material_law.h>

#include <memory>

namespace corotet
{
  /**
   * The compressible neo-Hookean law with the energy
   *
   *   W = mu / 2 (tr(F^T F) - 3) - mu ln J + lambda / 2 (ln J)^2,  J = det F,
   *
   * so P = mu (F - F^-T) + lambda ln J F^-T (@cite bonet2008, 6.4.3). Where
   * J <= 0 the energy is infinite, and there is no stress.
   */
  std::shared_ptr<const MaterialLaw>
  neo_hookean_law();
} // namespace corotet

#endif
