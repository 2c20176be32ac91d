// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/base/exceptions.h>
#include <corotet/forces/surface_forces.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/utilities.h>

#include <fmt/format.h>

#include <vector>

namespace corotet
{
  namespace
  {
    const std::string surface_forces_entry = "Loads/Surface forces";

    // The area of boundaries at rest [m^2]. Collective.
    double
    area_of(const std::vector<unsigned int> &boundaries,
            const ForceContext              &context)
    {
      double area = 0;
      for (const unsigned int id : boundaries)
        for (const BoundaryFace &face :
             context.discretization.boundary_faces(id))
          for_each_surface_point(context.discretization,
                                 context.reference,
                                 face,
                                 nullptr,
                                 [&](const SurfacePoint &point) {
                                   area += point.area.norm();
                                 });
      return dealii::Utilities::MPI::sum(area,
                                         context.discretization.communicator());
    }
  } // namespace

  void
  EvenTraction::integrate(Vector &f, const Field &force) const
  {
    Traction::integrate(f,
                        [&](const dealii::Point<3>     &x,
                            const dealii::Tensor<1, 3> &normal) {
                          return force(x, normal) / area;
                        });
  }

  void
  SurfaceForcesKind::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Loads");
    prm.add_parameter(
      "Surface forces",
      forces,
      "Total forces [N] on boundaries, spread evenly over their area at rest: "
      "'name: fx; fy; fz, ...', expressions in t. If several boundaries have "
      "the name, the force is spread over all of them together. The boundaries "
      "may have other conditions, too.");
    prm.leave_subsection();
  }

  std::vector<ForceKind::GivenEntry>
  SurfaceForcesKind::given() const
  {
    if (dealii::Utilities::trim(forces).empty())
      return {};
    return {{surface_forces_entry, forces, ""}};
  }

  void
  SurfaceForcesKind::add_to(ForceTerms         &terms,
                            const ForceContext &context) const
  {
    const std::string &entry = surface_forces_entry;
    for (const auto &[name, value, boundaries] :
         values_on_boundaries(context, forces, entry, "a surface force"))
      {
        const Expression force(value, 3, entry, context.tables);
        if (force.depends_on_space())
          throw InputError(entry,
                           fmt::format("found '{}' for '{}'; allowed: "
                                       "expressions in t, as it is the force "
                                       "on all of it",
                                       value,
                                       name));
        if (force.is_zero())
          continue;
        const double area = area_of(boundaries, context);
        for (const unsigned int id : boundaries)
          terms.add(std::make_unique<EvenTraction>(context.discretization,
                                                   context.reference,
                                                   id,
                                                   force,
                                                   area),
                    on_boundary(context, entry, id));
      }
  }
} // namespace corotet
