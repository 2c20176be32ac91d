// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/pressure.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Tensor;

  Pressure::Pressure(const Discretization                  &discretization,
                     const ReferenceElement                &reference,
                     const BoundaryConditions::SurfaceLoad &load,
                     const bool                             follow)
    : discretization(discretization)
    , reference(reference)
    , load(load)
    , follow(follow)
  {
    if (!follow)
      return;
    for_each_point(nullptr,
                   [&](const BoundaryFace &, const SurfacePoint &point) {
                     const auto  &t    = point.tangents;
                     const double side = std::max(t[0].norm(), t[1].norm());
                     inverse_height =
                       std::max(inverse_height,
                                side / cross_product_3d(t[0], t[1]).norm());
                   });
    inverse_height = dealii::Utilities::MPI::max(inverse_height,
                                                 discretization.communicator());
  }

  template <typename Function>
  void
  Pressure::for_each_point(const Vector *u, const Function &function) const
  {
    for (const BoundaryFace &face :
         discretization.boundary_faces(load.boundary))
      for_each_surface_point(
        discretization, reference, face, u, [&](const SurfacePoint &point) {
          function(face, point);
        });
  }

  void
  Pressure::add_force(Vector &f, const Motion &motion) const
  {
    for_each_point(follow ? &motion.u : nullptr,
                   [&](const BoundaryFace &face, const SurfacePoint &point) {
                     const auto  nodes = discretization.cell_nodes(face.cell);
                     const auto &values =
                       reference.face_rules[face.face].values;
                     const Tensor<1, 3> force =
                       -load.value.value(point.at_rest, motion.time) *
                       point.area;
                     for (const unsigned int i :
                          reference.face_nodes[face.face])
                       for (unsigned int a = 0; a < 3; ++a)
                         f.local_element(3 * nodes[i] + a) +=
                           force[a] * values[point.index][i];
                   });
  }

  void
  Pressure::linearize(const Motion &motion)
  {
    points.clear();
    for_each_point(&motion.u,
                   [&](const BoundaryFace &face, const SurfacePoint &point) {
                     const double weight =
                       reference.face_rules[face.face].weights[point.index];
                     points.push_back(
                       {&face,
                        point.index,
                        0.5 * weight *
                          load.value.value(point.at_rest, motion.time),
                        point.tangents});
                   });
  }

  void
  Pressure::add_linearized(Vector &f, const Vector &w, const double) const
  {
    for (const PressurePoint &point : points)
      {
        const unsigned int face  = point.face->face;
        const auto         nodes = discretization.cell_nodes(point.face->cell);
        const auto        &face_nodes = reference.face_nodes[face];
        const auto        &values     = reference.face_rules[face].values;
        std::array<Tensor<1, 3>, 2> dt;
        for (const unsigned int i : face_nodes)
          {
            const auto dN = face_derivatives(reference, face, point.index, i);
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int k = 0; k < 2; ++k)
                dt[k][a] += dN[k] * w.local_element(3 * nodes[i] + a);
          }
        const Tensor<1, 3> force =
          -point.pressure * (cross_product_3d(dt[0], point.tangents[1]) +
                             cross_product_3d(point.tangents[0], dt[1]));
        for (const unsigned int i : face_nodes)
          for (unsigned int a = 0; a < 3; ++a)
            f.local_element(3 * nodes[i] + a) +=
              force[a] * values[point.index][i];
      }
  }

  double
  Pressure::round_off(const Motion &motion,
                      const double  size,
                      const ForceRoundOff &) const
  {
    if (!follow)
      return 0;
    return 4 * std::numeric_limits<double>::epsilon() * inverse_height *
           motion.u.linfty_norm() * size;
  }

  void
  PressureKind::add_to(ForceTerms &terms, const ForceContext &context) const
  {
    const bool follow = !context.elasticity.law().is_linear();
    for (const auto &load : context.conditions.pressures)
      if (!load.value.is_zero())
        terms.add(std::make_unique<Pressure>(
                    context.discretization, context.reference, load, follow),
                  on_boundary(context,
                              "Boundary conditions/Pressure",
                              load.boundary));
  }
} // namespace corotet
