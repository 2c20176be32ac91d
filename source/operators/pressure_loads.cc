// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Pressures on the surface, at rest or deformed, and what the latter need more.

#include <corotet/operators/loads.h>
#include <corotet/operators/surface.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace corotet
{
  using dealii::Tensor;

  void
  Loads::add_pressure(Vector                                &f,
                      const BoundaryConditions::SurfaceLoad &load,
                      const double                           time,
                      const Vector                          &u) const
  {
    for (const BoundaryFace &face : discretization.boundary_faces())
      if (face.boundary == load.boundary)
        {
          const auto  nodes      = discretization.cell_nodes(face.cell);
          const auto &face_nodes = reference.face_nodes[face.face];
          const auto &values     = reference.face_rules[face.face].values;
          for_each_surface_point(discretization,
                                 reference,
                                 face,
                                 follow ? &u : nullptr,
                                 [&](const SurfacePoint &point) {
                                   const Tensor<1, 3> force =
                                     -load.value.value(point.at_rest, time) *
                                     point.area;
                                   for (const unsigned int i : face_nodes)
                                     for (unsigned int a = 0; a < 3; ++a)
                                       f.local_element(3 * nodes[i] + a) +=
                                         force[a] * values[point.index][i];
                                 });
        }
  }

  double
  Loads::relative_round_off(const Vector &u) const
  {
    return 4 * std::numeric_limits<double>::epsilon() * inverse_height *
           u.linfty_norm();
  }

  void
  Loads::linearize(const double time, const Vector &u)
  {
    pressure_points.clear();
    for (const auto &load : conditions.pressures)
      for (const BoundaryFace &face : discretization.boundary_faces())
        if (face.boundary == load.boundary)
          for_each_surface_point(
            discretization,
            reference,
            face,
            &u,
            [&](const SurfacePoint &point) {
              const double weight =
                reference.face_rules[face.face].weights[point.index];
              pressure_points.push_back(
                {&face,
                 point.index,
                 0.5 * weight * load.value.value(point.at_rest, time),
                 point.tangents});
            });
  }

  void
  Loads::add_linearized(Vector &f, const Vector &v, const double factor) const
  {
    scratch = 0;
    for (const PressurePoint &point : pressure_points)
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
                dt[k][a] += dN[k] * v.local_element(3 * nodes[i] + a);
          }
        const Tensor<1, 3> force =
          -point.pressure * (cross_product_3d(dt[0], point.tangents[1]) +
                             cross_product_3d(point.tangents[0], dt[1]));
        for (const unsigned int i : face_nodes)
          for (unsigned int a = 0; a < 3; ++a)
            scratch.local_element(3 * nodes[i] + a) +=
              force[a] * values[point.index][i];
      }
    scratch.compress(dealii::VectorOperation::add);
    f.add(factor, scratch);
  }

  void
  Loads::measure_faces()
  {
    for (const BoundaryFace &face : discretization.boundary_faces())
      for (const auto &pressure : conditions.pressures)
        if (face.boundary == pressure.boundary)
          for_each_surface_point(
            discretization,
            reference,
            face,
            nullptr,
            [&](const SurfacePoint &point) {
              const auto  &t    = point.tangents;
              const double side = std::max(t[0].norm(), t[1].norm());
              inverse_height =
                std::max(inverse_height,
                         side / cross_product_3d(t[0], t[1]).norm());
            });
    inverse_height = dealii::Utilities::MPI::max(inverse_height,
                                                 discretization.communicator());
  }
} // namespace corotet
