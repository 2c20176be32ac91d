// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/body_force.h>
#include <corotet/forces/force_kind.h>
#include <corotet/forces/gravity.h>
#include <corotet/forces/point_forces.h>
#include <corotet/forces/pressure.h>
#include <corotet/forces/rayleigh_damping.h>
#include <corotet/forces/traction.h>

namespace corotet
{
  namespace
  {
    template <typename Kind>
    std::unique_ptr<ForceKind>
    make()
    {
      return std::make_unique<Kind>();
    }
  } // namespace

  const std::vector<std::function<std::unique_ptr<ForceKind>()>> &
  force_kinds()
  {
    static const std::vector<std::function<std::unique_ptr<ForceKind>()>> kinds{
      make<GravityKind>,
      make<BodyForceKind>,
      make<PointForcesKind>,
      make<TractionKind>,
      make<PressureKind>,
      make<RayleighDampingKind>};
    return kinds;
  }

  ForceParameters::ForceParameters()
  {
    for (const auto &make_kind : force_kinds())
      kinds.push_back(make_kind());
  }

  void
  ForceParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    for (const auto &kind : kinds)
      kind->declare_parameters(prm);
  }

  std::vector<ForceKind::GivenEntry>
  ForceParameters::given() const
  {
    std::vector<ForceKind::GivenEntry> all;
    for (const auto &kind : kinds)
      for (const ForceKind::GivenEntry &entry : kind->given())
        all.push_back(entry);
    return all;
  }

  ForceTerms
  ForceParameters::make(const ForceContext &context) const
  {
    ForceTerms terms(context.discretization);
    for (const auto &kind : kinds)
      kind->add_to(terms, context);
    return terms;
  }
} // namespace corotet
