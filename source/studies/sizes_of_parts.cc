// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "sizes_of_parts.h"

#include <corotet/base/named_values.h>
#include <corotet/base/text.h>
#include <corotet/operators/surface.h>
#include <corotet/studies/study_run.h>

#include <deal.II/base/mpi.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace corotet
{
  std::map<std::string, double>
  StudyRun::sizes_of_selected_parts() const
  {
    const SelectionParameters &selections =
      parameters.simulation.mesh.selections;
    if (!selections.are_given())
      return {};
    const Body &body = simulated ? simulated->body() : analysis->body();
    const Discretization          &discretization = body.discretization;
    const ReferenceElement        &reference      = body.reference;
    const Mesh                    &mesh           = discretization.mesh();
    std::map<unsigned int, double> volumes, areas;
    for (unsigned int c = 0; c < discretization.n_owned_cells(); ++c)
      volumes[discretization.region(c)] += discretization.geometry(c).volume;
    for (const BoundaryFace &face : discretization.boundary_faces())
      for_each_surface_point(discretization,
                             reference,
                             face,
                             nullptr,
                             [&](const SurfacePoint &point) {
                               areas[face.boundary] += point.area.norm();
                             });

    std::vector<std::string> names;
    std::vector<double>      sizes;
    const auto               add = [&](const std::string                    &kind,
                         const MeshNames                      &known,
                         const std::string                    &selected,
                         const std::map<unsigned int, double> &of_ids) {
      for (const auto &[item, selection] : named_values(selected, "", ""))
        {
          const std::string name = without_quotes(item);
          double            sum  = 0;
          for (const unsigned int id : known.find(name))
            if (const auto found = of_ids.find(id); found != of_ids.end())
              sum += found->second;
          names.push_back(fmt::format("the {} '{}'", kind, name));
          sizes.push_back(sum);
        }
    };
    add("region", mesh.regions(), selections.regions, volumes);
    add("boundary", mesh.boundaries(), selections.boundaries, areas);
    dealii::Utilities::MPI::sum(sizes, discretization.communicator(), sizes);
    std::map<std::string, double> result;
    for (std::size_t i = 0; i < names.size(); ++i)
      result[names[i]] = sizes[i];
    return result;
  }

  std::string
  describe_changed_parts(const std::map<std::string, double> &before,
                         const std::map<std::string, double> &now)
  {
    // The tolerance allows for curved parts, whose size changes when refinement
    // puts new vertices on the geometry.
    constexpr double         tolerance = 2e-2;
    std::vector<std::string> changed;
    for (const auto &[name, size] : now)
      if (const auto found = before.find(name);
          found != before.end() &&
          std::abs(size - found->second) > tolerance * found->second)
        changed.push_back(
          fmt::format("{} has {:.4g} {} and had {:.4g}",
                      name,
                      size,
                      name.starts_with("the region") ? "m^3" : "m^2",
                      found->second));
    return join(changed);
  }
} // namespace corotet
