// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/laws/material_parameters.h>

#include <fmt/format.h>

namespace corotet
{
  Dilatation
  MaterialParameters::dilatation_of(const unsigned int degree,
                                    const MaterialLaw &law) const
  {
    const std::string entry = "Material/Dilatation";
    if (dilatation == Dilatation::vertices && degree != 1)
      throw InputError(entry,
                       fmt::format("found 'vertices' with elements of degree "
                                   "{}; allowed: 'cells', or degree 1",
                                   degree));
    // At degree 1 corotational laws take the rotations of cells.
    if (dilatation == Dilatation::vertices && !law.is_linear() &&
        !law.has_cell_rotation())
      throw InputError(entry,
                       "found 'vertices' with Material/Type = " + type.name() +
                         "; allowed: 'cells', or Type = linear or "
                         "corotational");
    return dilatation;
  }
} // namespace corotet
