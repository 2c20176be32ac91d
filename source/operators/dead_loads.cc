// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/operators/loads.h>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  Loads::DeadLoad::DeadLoad(const Kind         kind,
                            const Expression  &expression,
                            const unsigned int boundary)
    : kind(kind)
    , value(
        [expression](const Point<3> &x, const Tensor<1, 3> &, const double t) {
          return expression.vector_value(x, t);
        })
    , is_zero(expression.is_zero())
    , depends_on_space(expression.depends_on_space())
    , depends_on_time(expression.depends_on_time())
    , boundary(boundary)
  {}

  Loads::DeadLoad::DeadLoad(const Kind         kind,
                            const Value       &value,
                            const bool         depends_on_time,
                            const unsigned int boundary)
    : kind(kind)
    , value(value)
    , is_zero(false)
    , depends_on_space(true)
    , depends_on_time(depends_on_time)
    , boundary(boundary)
  {}

  void
  Loads::add_manufactured(const ExactSolution             &solution,
                          const IsotropicMaterial         &material,
                          const bool                       is_linear,
                          const bool                       with_inertia,
                          const std::vector<unsigned int> &boundaries)
  {
    const bool depends_on_time = solution.depends_on_time();
    add_dead_load(
      {DeadLoad::Kind::body_force,
       [=, &solution](const Point<3> &x, const Tensor<1, 3> &, const double t) {
         return solution.body_force(material, is_linear, with_inertia, x, t);
       },
       depends_on_time});
    for (const unsigned int boundary : boundaries)
      add_dead_load({DeadLoad::Kind::traction,
                     [=, &solution](const Point<3>     &x,
                                    const Tensor<1, 3> &normal,
                                    const double        t) {
                       return solution.stress(material, is_linear, x, t) *
                              normal;
                     },
                     depends_on_time,
                     boundary});
  }
} // namespace corotet
