// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_studies_choices_h
#define corotet_studies_choices_h

#include <string>

namespace corotet
{
  /**
   * The choices of a user, as lines of text: ready cases with their
   * descriptions, and the names of laws, forces, integrators, preconditioners,
   * sources of meshes and formats of their files, including those that programs
   * have added.
   */
  std::string
  list_choices();

  /// The first sentence of the comment at the beginning of a parameter file, at
  /// most one line long; a longer one is cut and ends with "...".
  std::string
  first_sentence(const std::string &parameter_file);
} // namespace corotet

#endif
