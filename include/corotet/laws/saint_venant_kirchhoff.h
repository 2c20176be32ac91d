// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_saint_venant_kirchhoff_h
#define corotet_laws_saint_venant_kirchhoff_h

#include <corotet/material/material_law.h>

#include <memory>

namespace corotet
{
  /// P = F S with S = lambda tr(E) I + 2 mu E and E = (F^T F - I) / 2
  /// (@cite bonet2008, 6.4.3).
  std::shared_ptr<const MaterialLaw>
  saint_venant_kirchhoff_law();
} // namespace corotet

#endif
