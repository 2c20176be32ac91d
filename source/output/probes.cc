// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/base/text.h>
#include <corotet/discretization/nearest_point.h>
#include <corotet/discretization/point_search.h>
#include <corotet/output/probes.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

namespace corotet
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;
    namespace mpi = dealii::Utilities::MPI;

    // The value for a point that no cell contains.
    constexpr double far_outside = -std::numeric_limits<double>::max();

    // The owned cell that contains a point, the point's reference coordinates
    // there, and its distance outside of the cell: the smallest barycentric
    // coordinate or 0.
    struct Location
    {
      unsigned int cell = 0;
      Point<3>     xi;
      double       outside = far_outside;
    };

    // Of the cells that contain the point, the one that it is least outside of.
    Location
    locate(const Point<3>    &x,
           const PointSearch &search,
           const NearbyCells &nearby)
    {
      Location best;
      for (const unsigned int cell : nearby.cells(x))
        if (const auto found = search.find(cell, x))
          {
            const Point<3> &xi = *found;
            const double    outside =
              std::min({xi[0], xi[1], xi[2], 1 - xi[0] - xi[1] - xi[2], 0.});
            if (outside > best.outside)
              best = {cell, xi, outside};
            if (outside == 0)
              break;
          }
      return best;
    }

    // The text "x in [0, 1], y in [0, 0.1], z in [0, 0.1]". Collective.
    std::string
    extents(const Discretization &discretization)
    {
      const auto [lower, upper] = discretization.bounding_box();
      std::string text;
      for (unsigned int c = 0; c < 3; ++c)
        text += fmt::format("{}{} in [{:.6g}, {:.6g}]",
                            c == 0 ? "" : ", ",
                            "xyz"[c],
                            lower[c],
                            upper[c]);
      return text;
    }
  } // namespace

  Point<3>
  nearest_point_to_probe(const ProbePoint     &probe,
                         const std::string    &entry,
                         const Discretization &discretization,
                         const NearbyCells    &nearby,
                         Log *const            log)
  {
    const auto &[name, x] = probe;
    if (log != nullptr)
      if (const auto nearest = nearest_point(discretization, nearby, x))
        {
          log->line(
            fmt::format("{}: '{}' is {:.3g} m outside the body: taken "
                        "at ({:.9g}, {:.9g}, {:.9g}), the nearest point",
                        entry,
                        shortened(name),
                        x.distance(*nearest),
                        (*nearest)[0],
                        (*nearest)[1],
                        (*nearest)[2]));
          return *nearest;
        }
    refuse_probe(probe, entry, discretization, nearby);
  }

  void
  refuse_probe(const ProbePoint     &probe,
               const std::string    &entry,
               const Discretization &discretization,
               const NearbyCells    &nearby)
  {
    const auto &[name, x] = probe;
    throw InputError(entry,
                     fmt::format("probe '{}' at ({}, {}, {}) lies outside the "
                                 "body, {:.3g} m from its nearest node; the "
                                 "body has {} (m)",
                                 shortened(name),
                                 x[0],
                                 x[1],
                                 x[2],
                                 mpi::min(nearby.distance_to_nodes(x),
                                          discretization.communicator()),
                                 extents(discretization)));
  }

  Probes::Probes(const std::vector<ProbePoint> &points,
                 const Discretization          &discretization,
                 Log *const                     log)
    : comm(discretization.communicator())
  {
    if (points.empty())
      return;
    const unsigned int rank   = mpi::this_mpi_process(comm);
    const unsigned int nobody = mpi::n_mpi_processes(comm);
    const auto        &fe     = discretization.finite_element().base_element(0);
    const PointSearch  search(discretization);
    const NearbyCells  nearby(discretization);
    for (const ProbePoint &point : points)
      {
        Location location = locate(point.position, search, nearby);
        double   outside  = mpi::max(location.outside, comm);
        if (outside == far_outside)
          {
            location =
              locate(nearest_point_to_probe(
                       point, "Output/Probes", discretization, nearby, log),
                     search,
                     nearby);
            outside = mpi::max(location.outside, comm);
            if (outside == far_outside)
              refuse_probe(point, "Output/Probes", discretization, nearby);
          }
        const unsigned int owner =
          mpi::min(location.outside == outside ? rank : nobody, comm);
        if (owner == rank)
          {
            const auto  nodes = discretization.cell_nodes(location.cell);
            ProbeInCell probe;
            probe.probe = probe_names.size();
            for (unsigned int i = 0; i < nodes.size(); ++i)
              {
                probe.nodes.push_back(nodes[i]);
                probe.shape_values.push_back(fe.shape_value(i, location.xi));
              }
            located.push_back(probe);
          }
        probe_names.push_back(point.name);
      }
  }

  std::vector<Tensor<1, 3>>
  Probes::displacements(const Vector &displacement) const
  {
    // Values are zero except on the rank that evaluates, so the sum is exact.
    std::vector<double> values(3 * probe_names.size(), 0.);
    for (const ProbeInCell &probe : located)
      for (unsigned int i = 0; i < probe.nodes.size(); ++i)
        for (unsigned int c = 0; c < 3; ++c)
          values[3 * probe.probe + c] +=
            probe.shape_values[i] *
            displacement.local_element(3 * probe.nodes[i] + c);
    mpi::sum(values, comm, values);

    std::vector<Tensor<1, 3>> result(probe_names.size());
    for (unsigned int p = 0; p < result.size(); ++p)
      for (unsigned int c = 0; c < 3; ++c)
        result[p][c] = values[3 * p + c];
    return result;
  }
} // namespace corotet
