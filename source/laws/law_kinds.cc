// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/laws/corotational.h>
#include <corotet/laws/law_kind.h>
#include <corotet/laws/linear.h>
#include <corotet/laws/neo_hookean.h>
#include <corotet/laws/saint_venant_kirchhoff.h>

namespace corotet
{
  std::vector<Candidate<LawKind>>
  law_kinds()
  {
    return with_added<LawKind>(
      {law_candidate("linear", linear_law),
       candidate<LawKind, CorotationalKind>("corotational"),
       law_candidate("Saint Venant-Kirchhoff", saint_venant_kirchhoff_law),
       law_candidate("neo-Hookean", neo_hookean_law)});
  }
} // namespace corotet
