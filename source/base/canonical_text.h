// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_base_canonical_text_h
#define corotet_base_canonical_text_h

#include <ginac/ginac.h>

#include <string>

namespace corotet
{
  /**
   * A formula as text for muParser, with terms and factors in the order of
   * their texts. GiNaC has them in the order of addresses in memory, which is
   * another one in each process, and with another order sums have other last
   * digits.
   */
  std::string
  canonical_text(const GiNaC::ex &formula);
} // namespace corotet

#endif
