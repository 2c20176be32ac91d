// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/traction.h>
#include <corotet/operators/surface.h>

namespace corotet
{
  using dealii::Tensor;

  Traction::Traction(const Discretization   &discretization,
                     const ReferenceElement &reference,
                     const unsigned int      boundary,
                     const Expression       &value)
    : DeadLoad(discretization, value)
    , reference(reference)
    , boundary(boundary)
  {}

  Traction::Traction(const Discretization   &discretization,
                     const ReferenceElement &reference,
                     const unsigned int      boundary,
                     const Value            &value,
                     const bool              depends_on_time)
    : DeadLoad(discretization, value, depends_on_time)
    , reference(reference)
    , boundary(boundary)
  {}

  void
  Traction::integrate(Vector &f, const Field &traction) const
  {
    for (const BoundaryFace &face : discretization.boundary_faces(boundary))
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
                                   traction(point.at_rest, point.area / area) *
                                   area;
                                 for (const unsigned int i : face_nodes)
                                   for (unsigned int a = 0; a < 3; ++a)
                                     f.local_element(3 * nodes[i] + a) +=
                                       force[a] * values[point.index][i];
                               });
      }
  }

  void
  TractionKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    for (const auto &[boundary, value] : context.conditions.tractions)
      if (!value.is_zero())
        terms.add(std::make_unique<Traction>(
                    context.discretization, context.reference, boundary, value),
                  on_boundary(context,
                              "Boundary conditions/Traction",
                              boundary));
  }
} // namespace corotet
