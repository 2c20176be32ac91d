// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_choices_h
#define corotet_studies_choices_h

#include <string>

namespace corotet
{
  /**
   * What a user can choose from, as lines of text: ready cases with what they
   * are about, and the names of laws, forces, integrators, preconditioners,
   * sources of meshes and formats of their files, those that programs have
   * added among them.
   */
  std::string
  list_choices();

  /// The first sentence of the comment that a parameter file begins with, of
  /// one line; a long one ends with "...".
  std::string
  first_sentence(const std::string &parameter_file);
} // namespace corotet

#endif
