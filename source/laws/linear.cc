// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/linear.h>
#include <corotet/operators/law_sweeps.h>

namespace corotet
{
  std::shared_ptr<const MaterialLaw>
  linear_law()
  {
    return std::make_shared<MaterialLawOf<LinearElasticity>>();
  }
} // namespace corotet
