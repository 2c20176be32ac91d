// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "problem.h"

#include <corotet/mesh/box_mesh.h>

#include <deal.II/base/parameter_handler.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace corotet::benchmarks
{
  using dealii::Point;
  using dealii::Tensor;

  SerialMesh
  beam(const std::array<unsigned int, 3> &cells)
  {
    BoxMesh                  source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("Size", fmt::format("{}, {}, {}", length, height, height));
    prm.set("Cells", fmt::format("{}, {}, {}", cells[0], cells[1], cells[2]));
    SerialMesh       mesh = source.create("");
    const Point<3>   upper(length, height, height);
    constexpr double frequency = 1e3;
    for (Point<3> &x : mesh.vertices)
      {
        const Point<3> rest = x;
        for (unsigned int a = 0; a < 3; ++a)
          if (rest[a] > 1e-10 && rest[a] < upper[a] - 1e-10)
            x[a] += 0.1 * upper[a] / cells[a] *
                    std::sin(frequency * (rest[a] + 2 * rest[(a + 1) % 3] +
                                          3 * rest[(a + 2) % 3]) +
                             a);
      }
    return mesh;
  }

  double
  first_period()
  {
    // Square of the first root of cos(k) cosh(k) = -1.
    const double k2 = 1.875104068711961 * 1.875104068711961;
    return 2 * std::numbers::pi / k2 * length * length / height *
           std::sqrt(12 * density / youngs_modulus);
  }

  Problem::Problem(const Case &c)
    : log(MPI_COMM_WORLD, true)
    , mesh(beam(c.cells), 0, 1., MPI_COMM_WORLD, log)
    , discretization(mesh, c.degree)
    , reference(c.degree)
    , mass(discretization, reference, {{0, density}}, MassType::consistent)
    , elasticity(
        discretization,
        reference,
        {{0, isotropic_material(youngs_modulus, poissons_ratio, density)}},
        true)
    , is_prescribed(3 * discretization.n_local_nodes(), 0)
  {
    for (unsigned int n = 0; n < discretization.n_local_nodes(); ++n)
      if (discretization.node_position(n)[0] < 1e-10)
        for (unsigned int a = 0; a < 3; ++a)
          is_prescribed[3 * n + a] = 1;
  }

  Vector
  Problem::vector() const
  {
    Vector v;
    discretization.initialize_vector(v);
    return v;
  }

  void
  Problem::clamp(Vector &v) const
  {
    for (unsigned int i = 0; i < v.locally_owned_size(); ++i)
      if (is_prescribed[i])
        v.local_element(i) = 0;
  }

  Vector
  Problem::bent(const double angle) const
  {
    const double radius = length / angle;
    Vector       u      = vector();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        const Point<3> x   = discretization.node_position(n);
        const double   phi = x[0] / radius;
        u.local_element(3 * n) =
          (radius - x[2] + height / 2) * std::sin(phi) - x[0];
        u.local_element(3 * n + 2) =
          (radius - x[2] + height / 2) * (1 - std::cos(phi));
      }
    u.update_ghost_values();
    return u;
  }

  Vector
  Problem::weight() const
  {
    Vector gravity = vector();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      gravity.local_element(3 * n + 2) = -standard_fall;
    gravity.update_ghost_values();
    Vector f = vector();
    mass.apply(f, gravity);
    clamp(f);
    return f;
  }

  Vector
  Problem::random_vector() const
  {
    Vector v = vector();
    for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
      {
        const Point<3> x = discretization.node_position(n);
        for (unsigned int a = 0; a < 3; ++a)
          v.local_element(3 * n + a) =
            std::sin(1e5 * (x[0] + 1.7 * x[1] + 2.3 * x[2]) + a);
      }
    clamp(v);
    v.update_ghost_values();
    return v;
  }
} // namespace corotet::benchmarks
