// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/dead_load.h>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  DeadLoad::DeadLoad(const Discretization &discretization,
                     const Expression     &value)
    : discretization(discretization)
    , value([value](const Point<3> &x, const Tensor<1, 3> &, const double t) {
      return value.vector_value(x, t);
    })
    , varies_in_space(value.depends_on_space())
    , varies_in_time(value.depends_on_time())
  {}

  DeadLoad::DeadLoad(const Discretization &discretization,
                     const Value          &value,
                     const bool            depends_on_time)
    : discretization(discretization)
    , value(value)
    , varies_in_space(true)
    , varies_in_time(depends_on_time)
  {}

  void
  DeadLoad::add_force(Vector &f, const Motion &motion) const
  {
    if (!varies_in_space && !varies_in_time)
      {
        const Tensor<1, 3> constant = value({}, {}, motion.time);
        integrate(f, [&](const Point<3> &, const Tensor<1, 3> &) {
          return constant;
        });
        return;
      }
    if (varies_in_space)
      {
        integrate(f, [&](const Point<3> &x, const Tensor<1, 3> &normal) {
          return value(x, normal, motion.time);
        });
        return;
      }
    if (!unit_forces)
      unit_forces = forces_of_unit_load();
    const Tensor<1, 3> now = value({}, {}, motion.time);
    for (const auto &[node, force] : *unit_forces)
      for (unsigned int a = 0; a < 3; ++a)
        f.local_element(3 * node + a) += now[a] * force[a];
  }

  std::vector<DeadLoad::NodalForce>
  DeadLoad::forces_of_unit_load() const
  {
    Vector integral;
    discretization.initialize_vector(integral);
    integrate(integral, [](const Point<3> &, const Tensor<1, 3> &) {
      return Tensor<1, 3>({1., 1., 1.});
    });
    integral.compress(dealii::VectorOperation::add);
    std::vector<NodalForce> result;
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        NodalForce nodal{n, {}};
        for (unsigned int a = 0; a < 3; ++a)
          nodal.force[a] = integral.local_element(3 * n + a);
        if (nodal.force != Tensor<1, 3>())
          result.push_back(nodal);
      }
    return result;
  }

  VectorFieldKind::VectorFieldKind(const std::string &entry,
                                   const std::string &quantity)
    : entry(entry)
    , quantity(quantity)
  {}

  void
  VectorFieldKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Loads");
    prm.add_parameter(entry,
                      text,
                      quantity + ": 'x; y; z', expressions in x, y, z, t.");
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  VectorFieldKind::given() const
  {
    if (is_zero_expression(text, 3))
      return {};
    return {{"Loads/" + entry, text, "0; 0; 0"}};
  }

  void
  VectorFieldKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    const Expression value(text, 3, "Loads/" + entry, context.tables);
    if (!value.is_zero())
      terms.add(make(value, context), "Loads/" + entry);
  }
} // namespace corotet
