// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef push_h
#define push_h

#include <corotet/discretization/discretization.h>
#include <corotet/forces/force_kind.h>
#include <corotet/operators/force_term.h>

/**
 * A force per volume at rest along x [N/m^3] that is the same everywhere and
 * whose value is a variable of the program.
 */
class Push : public corotet::ForceTerm
{
public:
  /// @p value must outlive this object. The value may be changed between steps.
  Push(const corotet::ForceContext &context, const double *value);

  /// Without dependence on time the force would be computed only once.
  bool
  depends_on_time() const override
  {
    return true;
  }

  void
  add_force(corotet::Vector &f, const corotet::Motion &motion) const override;

private:
  const double *value;
  /// The force for the value 1, on owned entries.
  corotet::Vector unit_force;
};

class PushKind : public corotet::ForceKind
{
public:
  explicit PushKind(const double *value)
    : value(value)
  {}

  void
  add_to(corotet::ForceTerms         &terms,
         const corotet::ForceContext &context) const override
  {
    terms.add(std::make_unique<Push>(context, value));
  }

private:
  const double *value;
};

#endif
