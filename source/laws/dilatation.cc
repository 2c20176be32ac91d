// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/laws/material_parameters.h>

#include <fmt/format.h>

namespace corotet
{
  Dilatation
  MaterialParameters::dilatation_of(const unsigned int degree) const
  {
    const std::string entry = "Material/Dilatation";
    if (dilatation == Dilatation::cells)
      return dilatation;
    if (degree != 1)
      throw InputError(entry,
                       fmt::format("found 'vertices' with elements of degree "
                                   "{}; allowed: 'cells', or degree 1",
                                   degree));
    if (!allows_vertex_dilatation(*law(degree)))
      throw InputError(entry,
                       "found 'vertices' with Material/Type = " + type.name() +
                         "; allowed: 'cells', or Type = linear or "
                         "corotational");
    return dilatation;
  }
} // namespace corotet
