// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_laws_corotational_h
#define corotet_laws_corotational_h

#include <corotet/laws/law_kind.h>

namespace corotet
{
  /// The corotational law P = R sigma(sym(R^T F) - I), with R of F = R S at the
  /// points that @p rotation names [seed, 2.73 to 2.76].
  std::shared_ptr<const MaterialLaw>
  corotational_law(const Rotation rotation);

  class CorotationalKind : public LawKind
  {
  public:
    bool
    has_rotations() const override
    {
      return true;
    }

    std::shared_ptr<const MaterialLaw>
    make(const Rotation rotation) const override;
  };
} // namespace corotet

#endif
