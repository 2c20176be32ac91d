// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Names of terms, for messages to users.

#include <corotet/base/vector.h>
#include <corotet/discretization/prescribed_motion.h>
#include <corotet/operators/force_terms.h>

#include <algorithm>
#include <cmath>

namespace corotet
{
  std::vector<std::string>
  ForceTerms::names_without_effect(const std::vector<Motion> &motions,
                                   const PrescribedMotion    &supports) const
  {
    std::vector<std::string> result;
    Vector                   f;
    discretization.initialize_vector(f);
    for (std::size_t i = 0; i < terms.size(); ++i)
      {
        if (names[i].empty())
          continue;
        double     on_all = 0, on_free = 0;
        const auto has_effect = [&] {
          // Round-off on nodes beside a face is ignored; the sums are squares.
          return on_free > 1e-24 * on_all;
        };
        const bool changes = terms[i]->role() == ForceTerm::Role::load &&
                             terms[i]->depends_on_time();
        const std::size_t n =
          changes ? motions.size() : std::min<std::size_t>(2, motions.size());
        for (std::size_t k = 0; k < n; ++k)
          {
            f = 0;
            terms[i]->add_force(f, motions[k]);
            f.compress(dealii::VectorOperation::add);
            // A formula that is not finite there counts as one with an effect.
            const double all = norm(f);
            if (!std::isfinite(all))
              {
                on_all = on_free = 1;
                break;
              }
            supports.set_zero(f);
            on_all += all * all;
            on_free += std::pow(norm(f), 2);
            if (has_effect())
              break;
          }
        if (on_all > 0 && !has_effect())
          result.push_back(names[i]);
      }
    return result;
  }



  std::vector<std::string>
  ForceTerms::names_of_damping() const
  {
    std::vector<std::string> result = names_left_out;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (terms[i]->role() == ForceTerm::Role::damping && !names[i].empty())
        result.push_back(names[i]);
    return result;
  }



  std::vector<std::string>
  ForceTerms::names_of_loads_in_time() const
  {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < terms.size(); ++i)
      if (terms[i]->role() == ForceTerm::Role::load &&
          terms[i]->depends_on_time() && !names[i].empty())
        result.push_back(names[i]);
    return result;
  }
} // namespace corotet
