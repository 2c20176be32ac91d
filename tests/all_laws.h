// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_all_laws_h
#define corotet_tests_all_laws_h

#include <corotet/laws/law_kind.h>

#include <memory>
#include <string>
#include <vector>

#include "parameter_text.h"

namespace corotet::tests
{
  /// A registered law, with one placement of rotations if it has any.
  struct NamedLaw
  {
    /// The name, such as "neo-Hookean" or "corotational, cell centre".
    std::string name;
    /// The entries of a parameter file that select the law.
    std::string                        text;
    std::shared_ptr<const MaterialLaw> law;
  };

  /// All registered laws, with each placement of rotations.
  inline const std::vector<NamedLaw> &
  all_laws()
  {
    static const std::vector<NamedLaw> laws = [] {
      std::vector<NamedLaw> result;
      for (const Candidate<LawKind> &candidate : law_kinds())
        {
          const auto kind = candidate.make();
          if (kind->has_rotations())
            for (const auto &[name, rotation] : rotations)
              result.push_back(
                {candidate.name + ", " + name,
                 material_type(candidate.name) + rotation_at(name),
                 kind->make(rotation)});
          else
            result.push_back({candidate.name,
                              material_type(candidate.name),
                              kind->make(Rotation::cell_centre)});
        }
      return result;
    }();
    return laws;
  }

  /// All laws that are not linear.
  inline const std::vector<NamedLaw> &
  nonlinear_laws()
  {
    static const std::vector<NamedLaw> laws = [] {
      std::vector<NamedLaw> result;
      for (const NamedLaw &law : all_laws())
        if (!law.law->is_linear())
          result.push_back(law);
      return result;
    }();
    return laws;
  }
} // namespace corotet::tests

#endif
