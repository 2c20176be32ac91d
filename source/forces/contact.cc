// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include <corotet/forces/contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace corotet
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    SurfaceMatrix::Tensor
    along(const Tensor<1, 3> &n)
    {
      return symmetrize(outer_product(n, n));
    }
  } // namespace

  template <typename Function>
  void
  Contact::for_each_point(const Motion   &motion,
                          const bool      with_ghosts,
                          const Function &function) const
  {
    const Discretization    &discretization = surface->discretization;
    const ReferenceElement  &reference      = surface->reference;
    const unsigned int       n_nodes        = surface->nodes_per_face();
    const Tensor<1, 3>       moved = the_obstacle->displacement(motion.time);
    std::array<Point<3>, 10> x;
    AssertIndexRange(n_nodes, x.size() + 1);
    for (const std::size_t f : nearby->find(motion.u, moved))
      {
        const ContactSurface::Face &face = surface->faces[f];
        if (!with_ghosts && face.cell >= discretization.n_owned_cells())
          continue;
        const unsigned int *nodes = surface->nodes_of(f);
        for (unsigned int k = 0; k < n_nodes; ++k)
          {
            x[k] = discretization.node_position(nodes[k]) - moved;
            for (unsigned int a = 0; a < 3; ++a)
              x[k][a] += motion.u.local_element(3 * nodes[k] + a);
          }
        const auto &face_nodes = reference.face_nodes[face.face];
        const auto &values     = reference.face_rules[face.face].values;
        for (unsigned int q = 0; q < surface->n_points; ++q)
          {
            // The values of all functions sum up to one.
            Tensor<1, 3> from_first;
            for (unsigned int k = 1; k < n_nodes; ++k)
              from_first += values[q][face_nodes[k]] * (x[k] - x[0]);
            const Obstacle::Gap gap = the_obstacle->gap(x[0] + from_first);
            if (gap.distance < 0)
              function(TouchingPoint{
                f, q, stiffness_of(face) * surface->area(f, q), gap});
          }
      }
  }

  void
  Contact::add_at(Vector              &f,
                  const TouchingPoint &point,
                  const Tensor<1, 3>  &force) const
  {
    const ContactSurface::Face &face = surface->faces[point.face];
    const auto  nodes  = surface->discretization.cell_nodes(face.cell);
    const auto &values = surface->reference.face_rules[face.face].values;
    for (const unsigned int i : surface->reference.face_nodes[face.face])
      for (unsigned int a = 0; a < 3; ++a)
        f.local_element(3 * nodes[i] + a) += force[a] * values[point.point][i];
  }

  Tensor<1, 3>
  Contact::value_at(const Vector &v, const TouchingPoint &point) const
  {
    const ContactSurface::Face &face = surface->faces[point.face];
    const auto   nodes  = surface->discretization.cell_nodes(face.cell);
    const auto  &values = surface->reference.face_rules[face.face].values;
    Tensor<1, 3> result;
    for (const unsigned int i : surface->reference.face_nodes[face.face])
      for (unsigned int a = 0; a < 3; ++a)
        result[a] += v.local_element(3 * nodes[i] + a) * values[point.point][i];
    return result;
  }

  template <typename Function>
  void
  Contact::add_tensors(SurfaceMatrix  &S,
                       const Motion   &motion,
                       const Function &tensor) const
  {
    auto boundary = surface->boundaries.begin();
    for_each_point(motion, true, [&](const TouchingPoint &point) {
      while (point.face >= boundary->first + boundary->n_faces)
        ++boundary;
      const unsigned int face =
        S.first_face(boundary->id) + (point.face - boundary->first);
      S.tensors_of(face)[point.point] += tensor(point);
    });
  }

  double
  NormalContact::energy(const Motion &motion) const
  {
    double sum = 0;
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      sum += 0.5 * point.stiffness * point.gap.distance * point.gap.distance;
    });
    return dealii::Utilities::MPI::sum(sum,
                                       surface->discretization.communicator());
  }

  void
  NormalContact::add_force(Vector &f, const Motion &motion) const
  {
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      add_at(f,
             point,
             -point.stiffness * point.gap.distance * point.gap.normal);
    });
  }

  void
  NormalContact::add_surface_matrix(SurfaceMatrix &S,
                                    const Motion  &motion,
                                    const double   c_u,
                                    const double) const
  {
    if (c_u == 0)
      return;
    add_tensors(S, motion, [&](const TouchingPoint &point) {
      return c_u * point.stiffness * along(point.gap.normal);
    });
  }

  void
  NormalContact::add_largest_surface_matrix(SurfaceMatrix &S) const
  {
    for (const ContactSurface::Boundary &boundary : surface->boundaries)
      {
        const unsigned int first = S.first_face(boundary.id);
        for (std::size_t i = 0; i < boundary.n_faces; ++i)
          {
            const std::size_t      f = boundary.first + i;
            SurfaceMatrix::Tensor *D = S.tensors_of(first + i);
            // The normal may have any direction.
            for (unsigned int q = 0; q < surface->n_points; ++q)
              D[q] += stiffness_of(surface->faces[f]) * surface->area(f, q) *
                      dealii::unit_symmetric_tensor<3>();
          }
      }
  }

  double
  NormalContact::round_off(const Motion &motion,
                           const double,
                           const ForceRoundOff &) const
  {
    // Positions are rounded, and their weights are.
    constexpr double epsilon = 4 * std::numeric_limits<double>::epsilon();
    const double     of_obstacle =
      the_obstacle->size() + the_obstacle->displacement(motion.time).norm();
    double sum = 0;
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      const ContactSurface::Face &face = surface->faces[point.face];
      const unsigned int          node = surface->discretization.cell_nodes(
        face.cell)[surface->reference.face_nodes[face.face][0]];
      double square = of_obstacle * of_obstacle;
      for (unsigned int a = 0; a < 3; ++a)
        square += std::pow(surface->discretization.node_position(node)[a], 2) +
                  std::pow(motion.u.local_element(3 * node + a), 2);
      sum += point.stiffness * point.stiffness * square;
    });
    return epsilon * std::sqrt(dealii::Utilities::MPI::sum(
                       sum, surface->discretization.communicator()));
  }

  double
  NormalContact::depth(const Motion &motion) const
  {
    double depth = -std::numeric_limits<double>::infinity();
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      depth = std::max(depth, -point.gap.distance);
    });
    return dealii::Utilities::MPI::max(depth,
                                       surface->discretization.communicator());
  }

  Friction::Sliding
  Friction::sliding(const TouchingPoint &point,
                    const Motion        &motion,
                    const Tensor<1, 3>  &velocity_of_obstacle) const
  {
    const Tensor<1, 3> &n = point.gap.normal;
    Tensor<1, 3>        v = value_at(motion.v, point) - velocity_of_obstacle;
    v -= (v * n) * n;
    return {v,
            std::sqrt(v.norm_square() + slip_velocity * slip_velocity),
            -coefficient * point.stiffness * point.gap.distance};
  }

  void
  Friction::add_force(Vector &f, const Motion &motion) const
  {
    const Tensor<1, 3> velocity = the_obstacle->velocity(motion.time);
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      const Sliding s = sliding(point, motion, velocity);
      add_at(f, point, -s.limit / s.speed * s.velocity);
    });
  }

  void
  Friction::add_surface_matrix(SurfaceMatrix &S,
                               const Motion  &motion,
                               const double,
                               const double c_v) const
  {
    if (c_v == 0)
      return;
    const Tensor<1, 3> velocity = the_obstacle->velocity(motion.time);
    add_tensors(S, motion, [&](const TouchingPoint &point) {
      const Sliding s = sliding(point, motion, velocity);
      return c_v * s.limit / s.speed *
             (dealii::unit_symmetric_tensor<3>() - along(point.gap.normal));
    });
  }

  Tensor<1, 3>
  Friction::direction_at(const TouchingPoint &point, const Sliding &now)
  {
    Direction &last = directions[surface->n_points * point.face + point.point];
    Tensor<1, 3> z  = now.velocity / now.speed;
    if (last.solve == n_solves)
      {
        // What the last linearization expects of this velocity.
        const Tensor<1, 3> change = now.velocity - last.velocity;
        z                         = (last.velocity + change -
             last.z * (last.velocity * change) / last.speed) /
            last.speed;
        z /= std::max(1., z.norm());
      }
    last = {n_solves, now.velocity, now.speed, z};
    return z;
  }

  void
  Friction::linearize(const Motion &motion)
  {
    if (directions.empty())
      directions.resize(surface->n_points * surface->faces.size());
    if (motion.time != linearized_time)
      ++n_solves;
    linearized_time = motion.time;
    points.clear();
    const Tensor<1, 3> velocity = the_obstacle->velocity(motion.time);
    for_each_point(motion, false, [&](const TouchingPoint &point) {
      const Sliding s = sliding(point, motion, velocity);
      points.push_back(
        {point,
         -coefficient * point.stiffness / s.speed * s.velocity,
         s.limit / (s.speed * s.speed) *
           symmetrize(outer_product(direction_at(point, s), s.velocity))});
    });
  }

  void
  Friction::add_linearized(Vector       &f,
                           const Vector &w,
                           const double  velocity_factor) const
  {
    for (const LinearizedPoint &at : points)
      {
        const Tensor<1, 3> v = value_at(w, at.point);
        // The pressure grows as the point moves against the normal.
        add_at(f,
               at.point,
               velocity_factor * (at.less_damping * v) -
                 (v * at.point.gap.normal) * at.of_pressure);
      }
  }
} // namespace corotet
