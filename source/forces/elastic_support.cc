// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/mpi.h>
#include <corotet/forces/elastic_support.h>

#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  SurfaceCoefficient::SurfaceCoefficient(const ForceContext &context,
                                         const unsigned int  boundary,
                                         const std::string  &text,
                                         const Direction     direction,
                                         const std::string  &entry)
    : discretization(context.discretization)
    , boundary(boundary)
    , value(text, direction == Direction::axes ? 3 : 1, entry, context.tables)
    , direction(direction)
    , entry(entry)
    , time(context.start_time)
    , coefficients(discretization, context.reference)
    , surface_operator(discretization)
  {
    evaluate(time);
  }

  double
  SurfaceCoefficient::checked_value(const Point<3>    &x,
                                    const unsigned int component) const
  {
    const double k = value.value(x, time, component);
    if (!(k >= 0) || !std::isfinite(k))
      throw InputError(
        entry,
        fmt::format("found the value {:g} at ({:.6g}, {:.6g}, {:.6g}) of "
                    "boundary '{}' at t = {:g}; allowed: finite values, "
                    "none below zero",
                    k,
                    x[0],
                    x[1],
                    x[2],
                    discretization.mesh().boundaries().name(boundary),
                    time));
    return k;
  }

  void
  SurfaceCoefficient::evaluate(const double time) const
  {
    this->time = time;
    coefficients.clear();
    on_all_ranks(discretization.communicator(), [&] {
      coefficients.add(boundary, [&](const SurfacePoint &point) {
        SurfaceMatrix::Tensor D;
        if (direction == Direction::axes)
          for (unsigned int a = 0; a < 3; ++a)
            D[a][a] = checked_value(point.at_rest, a);
        else
          {
            const Tensor<1, 3> n = point.area / point.area.norm();
            D =
              checked_value(point.at_rest, 0) * symmetrize(outer_product(n, n));
          }
        return D;
      });
    });
    surface_operator.set(coefficients);
  }

  const SurfaceMatrix &
  SurfaceCoefficient::matrix(const double time) const
  {
    if (depends_on_time() && time != this->time)
      try
        {
          evaluate(time);
        }
      catch (const InputError &error)
        {
          // The stored coefficients belong to no time.
          this->time = std::numeric_limits<double>::quiet_NaN();
          throw WrongValueError(error);
        }
    return coefficients;
  }

  const SurfaceOperator<double> &
  SurfaceCoefficient::operator_at(const double time) const
  {
    matrix(time);
    return surface_operator;
  }

  void
  SurfaceForce::add_force(Vector &f, const Motion &motion) const
  {
    coefficient.operator_at(motion.time).add(f, factor(motion), -1.);
  }

  void
  SurfaceForce::add_surface_matrix(SurfaceMatrix &S,
                                   const Motion  &motion,
                                   const double   c_u,
                                   const double   c_v) const
  {
    S.add(coefficient.matrix(motion.time),
          depends_on_displacement() ? c_u : c_v);
  }

  double
  SurfaceForce::round_off(const Motion &motion,
                          const double,
                          const ForceRoundOff &) const
  {
    return coefficient.operator_at(motion.time).round_off(factor(motion));
  }

  double
  ElasticSupport::energy(const Motion &motion) const
  {
    return coefficient.operator_at(motion.time).energy(motion.u);
  }

  void
  SupportsKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Supports");
    prm.add_parameter(
      "Elastic",
      elastic,
      "Springs between boundaries and the ground, by their stiffness in x, y "
      "and z per area at rest [N/m^3]: 'name: k_x; k_y; k_z, ...', expressions "
      "in x, y, z, t, not negative. Their energy counts as elastic energy; the "
      "work of changing the stiffness in time counts as external work. The "
      "boundaries may have other conditions, too; where the displacement is "
      "prescribed, springs add to the reaction only.");
    prm.add_parameter(
      "Elastic normal",
      elastic_normal,
      "Springs like those of Elastic, but along the surface's normal at rest "
      "only, by their stiffness per area at rest [N/m^3]: 'name: k, ...'.");
    prm.add_parameter(
      "Dashpots",
      dashpots,
      "Dashpots between boundaries and the ground, by their damping "
      "coefficient in x, y and z per area at rest [N s/m^3]: 'name: c_x; c_y; "
      "c_z, ...', expressions in x, y, z, t, not negative. The energy that "
      "they take counts as dissipated energy. With c = density times wave "
      "speed, a wave that arrives along the normal leaves the body without "
      "reflection. No effect in statics and modes.");
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  SupportsKind::given() const
  {
    std::vector<GivenEntry> result;
    const auto              add = [&](const std::string &name,
                         const std::string &value,
                         const bool         in_modes) {
      if (!dealii::Utilities::trim(value).empty())
        result.push_back({"Supports/" + name, value, "", in_modes});
    };
    add("Elastic", elastic, true);
    add("Elastic normal", elastic_normal, true);
    add("Dashpots", dashpots, false);
    return result;
  }

  void
  SupportsKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    using Direction     = SurfaceCoefficient::Direction;
    const auto for_each = [&](const std::string &name,
                              const std::string &text,
                              const Direction    direction,
                              const auto        &add) {
      const std::string entry = "Supports/" + name;
      for (const auto &[_, value, boundaries] : values_on_boundaries(
             context, text, entry, "an elastic support or a dashpot"))
        for (const unsigned int id : boundaries)
          {
            SurfaceCoefficient coefficient(
              context, id, value, direction, entry);
            if (!coefficient.is_zero())
              add(std::move(coefficient), on_boundary(context, entry, id));
          }
    };
    const auto add_springs = [&](SurfaceCoefficient &&stiffness,
                                 const std::string   &term) {
      terms.add(std::make_unique<ElasticSupport>(std::move(stiffness)), term);
    };
    for_each("Elastic", elastic, Direction::axes, add_springs);
    for_each("Elastic normal", elastic_normal, Direction::normal, add_springs);
    for_each("Dashpots",
             dashpots,
             Direction::axes,
             [&](SurfaceCoefficient &&damping, const std::string &term) {
               terms.add(std::make_unique<Dashpots>(std::move(damping)), term);
             });
  }
} // namespace corotet
