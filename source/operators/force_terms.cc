// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/discretization/prescribed_motion.h>
#include <corotet/operators/elastic_sweeps.h>
#include <corotet/operators/force_terms.h>

#include <algorithm>

#include "any_of.h"

namespace corotet
{
  namespace
  {
    using Role = ForceTerm::Role;

    bool
    depends_on_motion(const ForceTerm &term)
    {
      return term.depends_on_displacement() || term.depends_on_velocity();
    }

    bool
    is_constant_load(const ForceTerm &term)
    {
      return term.role() == Role::load && !term.depends_on_time() &&
             !depends_on_motion(term);
    }

    // A term that changes in time is changed from outside, so its work is
    // external.
    bool
    is_elastic(const ForceTerm &term)
    {
      return term.role() == Role::elastic && !term.depends_on_time();
    }

    // Load steps do not scale these terms.
    bool
    is_support(const ForceTerm &term)
    {
      return term.role() == Role::support ||
             (term.role() == Role::elastic && term.depends_on_time());
    }

    // Derivatives that are not symmetric belong to the exact tangent only.
    bool
    belongs_to(const Tangent tangent, const ForceTerm &term)
    {
      return term.has_linearization() &&
             (tangent == Tangent::consistent || term.is_symmetric());
    }
  } // namespace

  ForceTerms::ForceTerms(const Discretization &discretization)
    : discretization(discretization)
  {
    discretization.initialize_vector(constant_load);
  }

  Vector &
  ForceTerms::zero_vector() const
  {
    if (scratch.size() == 0)
      discretization.initialize_vector(scratch);
    scratch = 0;
    return scratch;
  }

  void
  ForceTerms::add(std::unique_ptr<ForceTerm> term, const std::string &name)
  {
    if (is_constant_load(*term))
      {
        // A constant load does not read the motion: any vector will do.
        term->add_force(constant_load, {0., constant_load, constant_load});
        constant_load.compress(dealii::VectorOperation::add);
      }
    terms.push_back(std::move(term));
    names.push_back(name);
  }

  void
  ForceTerms::leave_out_damping()
  {
    names_left_out = names_of_damping();
    for (std::size_t i = terms.size(); i-- > 0;)
      if (terms[i]->role() == Role::damping)
        {
          if (i < first_of_programs)
            --first_of_programs;
          terms.erase(terms.begin() + i);
          names.erase(names.begin() + i);
        }
  }

  void
  ForceTerms::external_force(Vector       &f,
                             const Motion &motion,
                             const double  load_factor) const
  {
    f = 0;
    for (const auto &term : terms)
      if (term->role() == Role::load && !is_constant_load(*term))
        term->add_force(f, motion);
    f.compress(dealii::VectorOperation::add);
    f += constant_load;
    f *= load_factor;
    if (!any_of(terms, is_support))
      return;
    Vector &of_supports = zero_vector();
    for (const auto &term : terms)
      if (is_support(*term))
        term->add_force(of_supports, motion);
    of_supports.compress(dealii::VectorOperation::add);
    f += of_supports;
  }

  bool
  ForceTerms::is_constant() const
  {
    return !follows_motion() && !any_of(terms, [](const ForceTerm &term) {
      return term.role() != Role::damping && term.depends_on_time();
    });
  }

  bool
  ForceTerms::follows_motion() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.role() != Role::damping && !is_elastic(term) &&
             depends_on_motion(term);
    });
  }

  void
  ForceTerms::elastic_force(Vector &f, const Motion &motion) const
  {
    f = 0;
    for (const auto &term : terms)
      if (is_elastic(*term))
        term->add_force(f, motion);
    f.compress(dealii::VectorOperation::add);
    f *= -1.;
  }

  bool
  ForceTerms::has_elastic() const
  {
    return any_of(terms, is_elastic);
  }

  double
  ForceTerms::energy(const Motion &motion) const
  {
    double sum = 0;
    for (const auto &term : terms)
      if (term->role() == Role::elastic)
        sum += term->energy(motion);
    return sum;
  }

  double
  ForceTerms::changing_energy(const Motion &motion) const
  {
    double sum = 0;
    for (const auto &term : terms)
      if (term->role() == Role::elastic && term->depends_on_time())
        sum += term->energy(motion);
    return sum;
  }

  void
  ForceTerms::damping_force(Vector &f, const Motion &motion) const
  {
    f = 0;
    for (const auto &term : terms)
      if (term->role() == Role::damping)
        term->add_force(f, motion);
    f.compress(dealii::VectorOperation::add);
    f *= -1.;
  }

  bool
  ForceTerms::has_damping() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.role() == Role::damping;
    });
  }

  bool
  ForceTerms::depends_on_velocity() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      return term.depends_on_velocity();
    });
  }

  bool
  ForceTerms::has_stiff_damping() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      const MatrixShares shares = term.damping_shares();
      return term.depends_on_velocity() &&
             (shares.stiffness > 0 || shares.mass == 0);
    });
  }

  bool
  ForceTerms::has_other_velocity_forces() const
  {
    return any_of(terms, [](const ForceTerm &term) {
      const MatrixShares shares = term.damping_shares();
      const bool         has_matrix =
        shares.stiffness != 0 || shares.mass != 0 || term.has_surface_matrix();
      return term.depends_on_velocity() && !has_matrix;
    });
  }

  bool
  ForceTerms::may_drive() const
  {
    return has_other_velocity_forces() ||
           any_of(terms, [](const ForceTerm &term) {
             return term.role() == Role::damping && !term.obstacle().empty() &&
                    term.depends_on_time();
           });
  }

  MatrixShares
  ForceTerms::damping_shares() const
  {
    MatrixShares sum;
    for (const auto &term : terms)
      {
        const MatrixShares shares = term->damping_shares();
        sum.stiffness += shares.stiffness;
        sum.mass += shares.mass;
      }
    return sum;
  }

  bool
  ForceTerms::is_linear() const
  {
    return !any_of(terms,
                   [](const ForceTerm &term) { return !term.is_linear(); });
  }

  bool
  ForceTerms::has_linearization(const Tangent tangent) const
  {
    return any_of(terms, [&](const ForceTerm &term) {
      return belongs_to(tangent, term);
    });
  }

  void
  ForceTerms::linearize(const Motion &motion, const Tangent tangent)
  {
    for (const auto &term : terms)
      if (belongs_to(tangent, *term))
        term->linearize(motion);
  }

  void
  ForceTerms::subtract_linearized(Vector       &f,
                                  const Vector &w,
                                  const double  load_factor,
                                  const double  velocity_factor,
                                  const Tangent tangent) const
  {
    for (const bool are_loads : {true, false})
      {
        const auto belongs = [&](const ForceTerm &term) {
          return belongs_to(tangent, term) &&
                 (term.role() == Role::load) == are_loads;
        };
        if (!any_of(terms, belongs))
          continue;
        Vector &derivative = zero_vector();
        for (const auto &term : terms)
          if (belongs(*term))
            term->add_linearized(derivative, w, velocity_factor);
        derivative.compress(dealii::VectorOperation::add);
        f.add(are_loads ? -load_factor : -1., derivative);
      }
  }

  bool
  ForceTerms::is_symmetric(const Tangent tangent) const
  {
    return !any_of(terms, [&](const ForceTerm &term) {
      return belongs_to(tangent, term) && !term.is_symmetric();
    });
  }

  bool
  ForceTerms::has_potential() const
  {
    return !any_of(terms,
                   [](const ForceTerm &term) { return !term.has_potential(); });
  }

  double
  ForceTerms::round_off(const Motion        &motion,
                        const double         size,
                        const ForceRoundOff &noise) const
  {
    double sum = 0;
    for (const auto &term : terms)
      sum += term->round_off(motion, size, noise);
    return sum;
  }
} // namespace corotet
