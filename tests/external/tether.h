// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef tether_h
#define tether_h

#include <corotet/discretization/discretization.h>
#include <corotet/forces/force_kind.h>
#include <corotet/operators/force_term.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

/**
 * A rope without mass from a node to a point in space that does not move: it
 * pulls when it is stretched and does not push,
 *
 *   f = - k max(l - L, 0) n,   l n = X + u - anchor,  |n| = 1.
 */
class Tether : public corotet::ForceTerm
{
public:
  /// A tether from the node nearest to @p point of the body at rest to @p
  /// anchor [m], with the stiffness k = @p stiffness [N/m] and the length L =
  /// @p length [m]. Collective.
  Tether(const corotet::Discretization &discretization,
         const dealii::Point<3>        &point,
         const dealii::Point<3>        &anchor,
         const double                   stiffness,
         const double                   length);

  bool
  depends_on_time() const override
  {
    return false;
  }

  bool
  depends_on_displacement() const override
  {
    return true;
  }

  Role
  role() const override
  {
    return Role::support;
  }

  void
  add_force(corotet::Vector &f, const corotet::Motion &motion) const override;

  bool
  has_linearization() const override
  {
    return true;
  }

  void
  linearize(const corotet::Motion &motion) override;

  void
  add_linearized(corotet::Vector       &f,
                 const corotet::Vector &w,
                 const double           velocity_factor) const override;

private:
  /// The vector from the anchor to the node.
  dealii::Tensor<1, 3>
  rope(const corotet::Vector &u) const;

  const dealii::Point<3> anchor;
  const double           stiffness;
  const double           length;
  /// The local number of the node, where this rank owns it.
  unsigned int     node = 0;
  bool             is_owned;
  dealii::Point<3> position;
  /// The derivative df/du at the last linearize().
  dealii::Tensor<2, 3> derivative;
};

/**
 * Section Tether of the parameter file.
 */
class TetherKind : public corotet::ForceKind
{
public:
  void
  declare_parameters(dealii::ParameterHandler &prm) override;

  std::vector<GivenEntry>
  given() const override;

  void
  add_to(corotet::ForceTerms         &terms,
         const corotet::ForceContext &context) const override;

private:
  dealii::Point<3> point;
  dealii::Point<3> anchor;
  double           stiffness = 0;
  double           length    = 0;
};

#endif
