// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/discretization/nearby_cells.h>
#include <corotet/discretization/nearest_point.h>
#include <corotet/forces/point_forces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/types.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    const std::string point_forces_entry = "Loads/Point forces";

    // The node at this distance, up to round-off. If there are several, it is
    // the one with the lowest coordinates, which is the same on any number of
    // ranks. Returns its number on the rank that owns it, an invalid one on
    // other ranks, and how many such nodes there are. Collective.
    std::pair<unsigned int, unsigned int>
    nearest_node(const Discretization &discretization,
                 const NearbyCells    &nearby,
                 const Point<3>       &target,
                 const double          distance)
    {
      constexpr double          round_off = 1e-9;
      const MPI_Comm            comm      = discretization.communicator();
      std::vector<unsigned int> nodes =
        nearby.nodes(target, (1 + round_off) * distance);
      const auto n_nearest =
        dealii::Utilities::MPI::sum<unsigned int>(nodes.size(), comm);
      for (unsigned int a = 0; a < 3; ++a)
        {
          const auto coordinate = [&](const unsigned int n) {
            return discretization.node_position(n)[a];
          };
          double lowest = std::numeric_limits<double>::infinity();
          for (const unsigned int n : nodes)
            lowest = std::min(lowest, coordinate(n));
          lowest = dealii::Utilities::MPI::min(lowest, comm);
          std::erase_if(nodes, [&](const unsigned int n) {
            return coordinate(n) > lowest + round_off * distance;
          });
        }
      return {nodes.empty() ? dealii::numbers::invalid_unsigned_int : nodes[0],
              n_nearest};
    }
  } // namespace

  PointForce::PointForce(const Discretization &discretization,
                         const NearbyCells    &nearby,
                         const Point<3>       &target,
                         const Expression     &value,
                         Log                  &log)
    : value(value)
  {
    const MPI_Comm comm = discretization.communicator();
    const double   minimum =
      dealii::Utilities::MPI::min(nearby.distance_to_nodes(target), comm);
    const auto [found, n_nearest] =
      nearest_node(discretization, nearby, target, minimum);
    const unsigned int none = dealii::numbers::invalid_unsigned_int;
    node                    = found == none ? 0 : found;
    const unsigned int rank = dealii::Utilities::MPI::this_mpi_process(comm);
    const unsigned int owner =
      dealii::Utilities::MPI::min(found == none ? none : rank, comm);
    position =
      dealii::Utilities::MPI::broadcast(comm,
                                        rank == owner ?
                                          discretization.node_position(node) :
                                          Point<3>(),
                                        owner);
    if (!nearest_point(discretization, nearby, target))
      throw InputError(
        point_forces_entry,
        fmt::format(
          "the point ({:.6g}, {:.6g}, {:.6g}) lies outside the body: "
          "found a distance of {:.3g} m to the nearest node, ({:.6g}, "
          "{:.6g}, {:.6g}); allowed are points of the body",
          target[0],
          target[1],
          target[2],
          minimum,
          position[0],
          position[1],
          position[2]));
    log.line(fmt::format(
      "Point force at node ({:.6g}, {:.6g}, {:.6g}), {:.3g} m from ({:.6g}, "
      "{:.6g}, {:.6g}){}",
      position[0],
      position[1],
      position[2],
      minimum,
      target[0],
      target[1],
      target[2],
      n_nearest > 1 ?
        fmt::format(": of {} that are as near, the one with the lowest "
                    "coordinates",
                    n_nearest) :
        ""));
    is_owned = rank == owner;
  }

  void
  PointForce::add_force(Vector &f, const Motion &motion) const
  {
    if (!is_owned)
      return;
    const Tensor<1, 3> now = value.vector_value(position, motion.time);
    for (unsigned int a = 0; a < 3; ++a)
      f.local_element(3 * node + a) += now[a];
  }

  void
  PointForcesKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Loads");
    prm.add_parameter(
      "Point forces",
      forces,
      "Forces [N], each on the node nearest to a point of the body at rest "
      "[m]: 'x y z: fx; fy; fz, ...', forces as expressions in x, y, z, t.");
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  PointForcesKind::given() const
  {
    if (dealii::Utilities::trim(forces).empty())
      return {};
    return {{point_forces_entry, forces, ""}};
  }

  void
  PointForcesKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    const std::string entry   = point_forces_entry,
                      allowed = "'x y z: fx; fy; fz'";
    std::optional<NearbyCells> nearby;
    for (const auto &[place, force] : named_values(forces, entry, allowed))
      {
        const auto target = point_of(place);
        if (!target)
          throw InputError(entry,
                           fmt::format("found '{}'; allowed: {}",
                                       shortened(place + ": " + force),
                                       allowed));
        if (!nearby)
          nearby.emplace(context.discretization);
        terms.add(std::make_unique<PointForce>(
                    context.discretization,
                    *nearby,
                    *target,
                    Expression(force, 3, entry, context.tables),
                    context.log),
                  entry + " '" + shortened(place) + "'");
      }
  }
} // namespace corotet
