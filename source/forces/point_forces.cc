// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/named_values.h>
#include <corotet/forces/point_forces.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  PointForce::PointForce(const Discretization &discretization,
                         const Point<3>       &target,
                         const Expression     &value,
                         Log                  &log)
    : value(value)
  {
    // The nearest node; of several the one with the lowest number.
    double distance = std::numeric_limits<double>::infinity();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      if (discretization.node_position(n).distance(target) < distance)
        {
          node     = n;
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
    position =
      dealii::Utilities::MPI::broadcast(comm,
                                        rank == owner ?
                                          discretization.node_position(node) :
                                          Point<3>(),
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
      "Forces [N] at the nodes nearest to points of the body at rest: 'x y z: "
      "fx; fy; fz, ...', forces as expressions in x, y, z, t.");
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  PointForcesKind::given() const
  {
    if (dealii::Utilities::trim(forces).empty())
      return {};
    return {{"Loads/Point forces", forces, ""}};
  }

  void
  PointForcesKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    const std::string entry   = "Loads/Point forces",
                      allowed = "'x y z: fx; fy; fz'";
    for (const auto &[place, force] : named_values(forces, entry, allowed))
      {
        const auto target = point_of(place);
        if (!target)
          throw InputError(
            entry,
            fmt::format("found '{}: {}'; allowed: {}", place, force, allowed));
        terms.add(std::make_unique<PointForce>(
          context.discretization,
          *target,
          Expression(force, 3, entry, context.tables),
          context.log));
      }
  }
} // namespace corotet
