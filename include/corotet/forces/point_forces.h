// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_forces_point_forces_h
#define corotet_forces_point_forces_h

#include <corotet/base/expression.h>
#include <corotet/discretization/nearby_cells.h>
#include <corotet/forces/force_kind.h>

#include <deal.II/base/point.h>

namespace corotet
{
  /**
   * Section Loads, entry Point forces: a force [N] at a node.
   */
  class PointForce : public ForceTerm
  {
  public:
    /// A force @p value [N], three components, at the node nearest to the point
    /// @p target of the body at rest. @p nearby belongs to @p discretization.
    /// Collective.
    PointForce(const Discretization   &discretization,
               const NearbyCells      &nearby,
               const dealii::Point<3> &target,
               const Expression       &value,
               Log                    &log);

    bool
    depends_on_time() const override
    {
      return value.depends_on_time();
    }

    void
    add_force(Vector &f, const Motion &motion) const override;

  private:
    const Expression value;
    dealii::Point<3> position;
    /// Local number of the node; used only where the node is owned.
    unsigned int node = 0;
    bool         is_owned;
  };

  class PointForcesKind : public ForceKind
  {
  public:
    void
    declare_parameters(dealii::ParameterHandler &prm) override;

    std::vector<GivenEntry>
    given() const override;

    void
    add_to(ForceTerms &terms, const ForceContext &context) const override;

  private:
    std::string forces;
  };
} // namespace corotet

#endif
