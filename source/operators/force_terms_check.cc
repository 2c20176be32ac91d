// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// A check of the forces that programs add.

#include <corotet/operators/force_terms.h>

#include <algorithm>

namespace corotet
{
  std::vector<std::pair<std::string, double>>
  ForceTerms::derivative_errors(const Motion &motion,
                                const Vector &w,
                                const double  velocity_factor)
  {
    // Small enough for the error of central differences, and large enough for
    // round-off.
    constexpr double step = 1e-3;
    // Changes of the force below this part of it say nothing.
    constexpr double                            least = 1e-10;
    std::vector<std::pair<std::string, double>> result;
    for (std::size_t i = first_of_programs; i < terms.size(); ++i)
      {
        ForceTerm         &term   = *terms[i];
        const MatrixShares shares = term.damping_shares();
        if (!(term.depends_on_displacement() || term.depends_on_velocity()) ||
            term.has_surface_matrix() || shares.stiffness != 0 ||
            shares.mass != 0)
          continue;
        Vector u(w), v(w), difference(w), derivative(w);
        double force = 0;
        difference   = 0;
        for (const double sign : {1., -1.})
          {
            u.equ(1., motion.u);
            u.add(sign * step, w);
            u.update_ghost_values();
            v.equ(1., motion.v);
            v.add(sign * step * velocity_factor, w);
            v.update_ghost_values();
            Vector &f = zero_vector();
            term.add_force(f, {motion.time, u, v});
            f.compress(dealii::VectorOperation::add);
            difference.add(sign / (2 * step), f);
            force = std::max(force, norm(f));
          }
        derivative = 0;
        if (term.has_linearization())
          {
            Vector &sum = zero_vector();
            term.linearize(motion);
            term.add_linearized(sum, w, velocity_factor);
            sum.compress(dealii::VectorOperation::add);
            derivative = sum;
          }
        const double size = std::max(norm(difference), norm(derivative));
        difference -= derivative;
        if (step * size > least * force)
          result.emplace_back(names[i], norm(difference) / size);
      }
    return result;
  }
} // namespace corotet
