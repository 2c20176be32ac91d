// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/operators/loads.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  void
  LoadParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.add_parameter("Gravity",
                      gravity,
                      "Acceleration [m/s^2] of gravity: 'x; y; z', expressions "
                      "in x, y, z, t.");
    prm.add_parameter("Body force",
                      body_force,
                      "Force per volume at rest [N/m^3]: 'x; y; z', "
                      "expressions in x, y, z, t.");
    prm.add_parameter(
      "Point forces",
      point_forces,
      "Forces [N] at the nodes nearest to points of the body at rest: 'x y z: "
      "fx; fy; fz, ...', forces as expressions in x, y, z, t.");
  }

  Loads::Loads(const Discretization     &discretization,
               const ReferenceElement   &reference,
               const Mass               &mass,
               const BoundaryConditions &conditions,
               const LoadParameters     &parameters,
               const bool                follow,
               Log                      &log,
               const TableFunctions     &tables)
    : discretization(discretization)
    , reference(reference)
    , mass(mass)
    , conditions(conditions)
    , follow(follow)
  {
    discretization.initialize_vector(scratch);
    discretization.initialize_vector(constant_force);
    add_dead_load({DeadLoad::Kind::gravity,
                   Expression(parameters.gravity, 3, "Loads/Gravity", tables)});
    add_dead_load(
      {DeadLoad::Kind::body_force,
       Expression(parameters.body_force, 3, "Loads/Body force", tables)});
    for (const auto &traction : conditions.tractions)
      add_dead_load(
        {DeadLoad::Kind::traction, traction.value, traction.boundary});
    if (!dealii::Utilities::trim(parameters.point_forces).empty())
      for (const std::string &item :
           split_outside_brackets(parameters.point_forces, ','))
        point_forces.push_back(locate(item, tables, log));
    if (has_follower_pressure())
      measure_faces();
  }

  void
  Loads::add_dead_load(DeadLoad load)
  {
    if (load.is_zero)
      return;
    if (!load.depends_on_time)
      {
        integrate(scratch,
                  load,
                  [&](const Point<3> &x, const Tensor<1, 3> &normal) {
                    return load.value(x, normal, 0.);
                  });
        constant_force += scratch;
        return;
      }
    if (!load.depends_on_space)
      {
        discretization.initialize_vector(load.integral);
        integrate(load.integral,
                  load,
                  [](const Point<3> &, const Tensor<1, 3> &) {
                    return Tensor<1, 3>({1., 1., 1.});
                  });
      }
    dead_loads.push_back(std::move(load));
  }

  void
  Loads::force(Vector &f, const double time, const Vector &u) const
  {
    if (conditions.pressures.empty())
      f = constant_force;
    else
      {
        f = 0;
        for (const auto &pressure : conditions.pressures)
          add_pressure(f, pressure, time, u);
        f.compress(dealii::VectorOperation::add);
        f += constant_force;
      }

    for (const DeadLoad &load : dead_loads)
      if (!load.depends_on_space)
        {
          const Tensor<1, 3> value = load.value({}, {}, time);
          for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
            for (unsigned int a = 0; a < 3; ++a)
              f.local_element(3 * n + a) +=
                value[a] * load.integral.local_element(3 * n + a);
        }
      else
        {
          integrate(scratch,
                    load,
                    [&](const Point<3> &x, const Tensor<1, 3> &normal) {
                      return load.value(x, normal, time);
                    });
          f.add(1., scratch);
        }

    for (const PointForce &point : point_forces)
      if (point.is_owned)
        {
          const Tensor<1, 3> value =
            point.value.vector_value(point.position, time);
          for (unsigned int a = 0; a < 3; ++a)
            f.local_element(3 * point.node + a) += value[a];
        }
  }

  template <typename Value>
  void
  Loads::integrate(Vector &f, const DeadLoad &load, const Value &value) const
  {
    switch (load.kind)
      {
        case DeadLoad::Kind::gravity:
          {
            Vector acceleration(f);
            for (unsigned int n = 0; n < discretization.n_local_nodes(); ++n)
              {
                const Tensor<1, 3> g =
                  value(discretization.node_position(n), Tensor<1, 3>());
                for (unsigned int a = 0; a < 3; ++a)
                  acceleration.local_element(3 * n + a) = g[a];
              }
            mass.apply(f, acceleration);
            return;
          }
        case DeadLoad::Kind::body_force:
          return integrate_body_force(f, value);
        case DeadLoad::Kind::traction:
          return integrate_traction(f, load.boundary, value);
      }
  }

  template <typename Value>
  void
  Loads::integrate_body_force(Vector &f, const Value &value) const
  {
    f                = 0;
    const auto &rule = reference.load_rule;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      {
        const CellGeometry &geometry  = discretization.geometry(c);
        const bool          is_curved = discretization.is_curved(c);
        const auto          nodes     = discretization.cell_nodes(c);
        const Point<3>      origin    = discretization.node_position(nodes[0]);
        const Tensor<2, 3>  J         = invert(geometry.inverse_jacobian);
        for (unsigned int q = 0; q < rule.weights.size(); ++q)
          {
            Point<3> x      = origin + J * rule.points[q];
            double   volume = geometry.volume;
            if (is_curved)
              {
                x = Point<3>();
                for (unsigned int i = 0; i < reference.n_nodes; ++i)
                  x +=
                    rule.values[q][i] * discretization.node_position(nodes[i]);
                volume = determinant(discretization.jacobian(c, rule, q)) / 6;
              }
            const Tensor<1, 3> b =
              value(x, Tensor<1, 3>()) * (rule.weights[q] * volume);
            for (unsigned int i = 0; i < reference.n_nodes; ++i)
              for (unsigned int a = 0; a < 3; ++a)
                f.local_element(3 * nodes[i] + a) += b[a] * rule.values[q][i];
          }
      }
    f.compress(dealii::VectorOperation::add);
  }

  template <typename Value>
  void
  Loads::integrate_traction(Vector            &f,
                            const unsigned int boundary,
                            const Value       &value) const
  {
    f = 0;
    for (const BoundaryFace &face : discretization.boundary_faces())
      if (face.boundary == boundary)
        {
          const auto  nodes      = discretization.cell_nodes(face.cell);
          const auto &face_nodes = reference.face_nodes[face.face];
          const auto &values     = reference.face_rules[face.face].values;
          for_each_surface_point(discretization,
                                 reference,
                                 face,
                                 nullptr,
                                 [&](const SurfacePoint &point) {
                                   const double       area = point.area.norm();
                                   const Tensor<1, 3> force =
                                     value(point.at_rest, point.area / area) *
                                     area;
                                   for (const unsigned int i : face_nodes)
                                     for (unsigned int a = 0; a < 3; ++a)
                                       f.local_element(3 * nodes[i] + a) +=
                                         force[a] * values[point.index][i];
                                 });
        }
    f.compress(dealii::VectorOperation::add);
  }

  bool
  Loads::is_constant() const
  {
    const auto depends_on_time = [](const auto &load) {
      return load.value.depends_on_time();
    };
    return !has_follower_pressure() && dead_loads.empty() &&
           std::none_of(conditions.pressures.begin(),
                        conditions.pressures.end(),
                        depends_on_time) &&
           std::none_of(point_forces.begin(),
                        point_forces.end(),
                        depends_on_time);
  }

  bool
  Loads::has_follower_pressure() const
  {
    return follow && !conditions.pressures.empty();
  }

  Loads::PointForce
  Loads::locate(const std::string    &text,
                const TableFunctions &tables,
                Log                  &log) const
  {
    const std::string   entry = "Loads/Point forces";
    const std::size_t   colon = text.find(':');
    std::vector<double> coordinates;
    try
      {
        coordinates = dealii::Utilities::string_to_double(
          dealii::Utilities::split_string_list(text.substr(0, colon), ' '));
      }
    catch (const dealii::ExceptionBase &)
      {}
    if (colon == std::string::npos || coordinates.size() != 3)
      throw InputError(entry,
                       fmt::format("found '{}'; allowed: 'x y z: fx; fy; fz'",
                                   text));
    const Point<3> target(coordinates[0], coordinates[1], coordinates[2]);
    Expression     value(text.substr(colon + 1), 3, entry, tables);

    // The nearest node; of several the one with the lowest number.
    unsigned int nearest  = 0;
    double       distance = std::numeric_limits<double>::infinity();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      if (discretization.node_position(n).distance(target) < distance)
        {
          nearest  = n;
          distance = discretization.node_position(n).distance(target);
        }
    const MPI_Comm     comm    = discretization.communicator();
    const double       minimum = dealii::Utilities::MPI::min(distance, comm);
    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(comm);
    const unsigned int owner =
      dealii::Utilities::MPI::min(distance == minimum ?
                                    rank :
                                    std::numeric_limits<unsigned int>::max(),
                                  comm);
    const Point<3> position = dealii::Utilities::MPI::broadcast(
      comm,
      rank == owner ? discretization.node_position(nearest) : Point<3>(),
      owner);
    log.line(fmt::format(
      "Point force at node ({:.6g}, {:.6g}, {:.6g}), {:.3g} m from ({:.6g}, "
      "{:.6g}, {:.6g})",
      position[0],
      position[1],
      position[2],
      minimum,
      target[0],
      target[1],
      target[2]));
    return {std::move(value), position, nearest, rank == owner};
  }
} // namespace corotet
