// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#include "problem.h"

#include <corotet/mesh/box_mesh.h>
#include <corotet/mesh/gmsh_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "measure.h"

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
    // The square of the first root of cos(k) cosh(k) = -1.
    const double k2 = 1.875104068711961 * 1.875104068711961;
    return 2 * std::numbers::pi / k2 * length * length / height *
           std::sqrt(12 * density / youngs_modulus);
  }

  SerialMesh
  serial_mesh(const Case &c)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return {};
    SerialMesh mesh;
    if (c.mesh.empty())
      mesh = beam(c.cells);
    else
      {
        GmshMesh                 source;
        dealii::ParameterHandler prm;
        source.declare_parameters(prm);
        prm.set("File", c.mesh);
        if (c.element_size > 0)
          prm.set("Element size", c.element_size);
        mesh = source.create("");
      }
    double end = 0;
    for (const Point<3> &x : mesh.vertices)
      end = std::max(end, x[0]);
    for (SerialMesh::Cell &cell : mesh.cells)
      {
        double x = 0;
        for (const unsigned int vertex : cell.vertices)
          x += mesh.vertices[vertex][0] / 4;
        cell.region = x > end / 2 ? 1 : 0;
      }
    mesh.regions.names = {{0, "clamped"}, {1, "free"}};
    return mesh;
  }

  namespace
  {
    SerialMesh
    mesh_and_memory(const Case &c, double &memory)
    {
      SerialMesh mesh = serial_mesh(c);
      memory = dealii::Utilities::MPI::sum(present_memory(), MPI_COMM_WORLD);
      return mesh;
    }

    // The position of the point @p x of the straight beam after it is bent to
    // an arc.
    Point<3>
    bend(const Point<3> &x, const double angle)
    {
      if (angle == 0)
        return x;
      const double radius = length / angle;
      const double phi    = x[0] / radius;
      const double offset = radius - x[2] + height / 2;
      return {offset * std::sin(phi),
              x[1],
              x[2] + offset * (1 - std::cos(phi))};
    }

    // The displacement for a map of positions.
    template <typename Map>
    Vector
    displacement(const Discretization &discretization, const Map &map)
    {
      Vector u;
      discretization.initialize_vector(u);
      for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
        {
          const Point<3>     x = discretization.node_position(n);
          const Tensor<1, 3> d = map(x) - x;
          for (unsigned int a = 0; a < 3; ++a)
            u.local_element(3 * n + a) = d[a];
        }
      u.update_ghost_values();
      return u;
    }
  } // namespace

  ProblemInput::ProblemInput(const std::string &text)
    : log(MPI_COMM_WORLD, true)
  {
    parameters.declare_parameters(prm);
    prm.parse_input_from_string(text);
  }

  std::string
  body_text(const Case &c)
  {
    return fmt::format(R"(
      subsection Discretization
        set Degree = {}
      end
      subsection Material
        set Young's modulus = clamped: {}, free: {}
        set Poisson's ratio = {}
        set Density         = {}
      end
      subsection Boundary conditions
        set Fixed = {}
      end
    )",
                       c.degree,
                       youngs_modulus,
                       youngs_modulus * c.jump,
                       c.poissons_ratio,
                       density,
                       c.clamped);
  }

  Problem::Problem(const Case &c)
    : ProblemInput(body_text(c))
    , Body(parameters, mesh_and_memory(c, memory_at_start), MPI_COMM_WORLD, log)
    , state(bent(c.bend))
  {
    reset_rotations();
  }

  std::unique_ptr<Elasticity>
  Problem::elasticity_with(const std::shared_ptr<const MaterialLaw> &law) const
  {
    return std::make_unique<Elasticity>(discretization,
                                        reference,
                                        materials,
                                        law);
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
      if (motion.is_prescribed()[i])
        v.local_element(i) = 0;
  }

  Vector
  Problem::bent(const double angle) const
  {
    return displacement(discretization,
                        [angle](const Point<3> &x) { return bend(x, angle); });
  }

  Vector
  Problem::deformed() const
  {
    return displacement(discretization, [](const Point<3> &x) {
      const double twist = 2 * x[0] / length;
      const double y     = 1.08 * (x[1] - height / 2);
      const double z     = 0.91 * (x[2] - height / 2);
      const double wave  = 0.01 * length * std::sin(10 * x[0] / length);
      return bend({1.05 * x[0] + wave,
                   height / 2 + std::cos(twist) * y - std::sin(twist) * z,
                   height / 2 + std::sin(twist) * y + std::cos(twist) * z},
                  1.5);
    });
  }

  void
  Problem::reset_rotations()
  {
    elasticity.update_rotations(state);
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
    return v;
  }
} // namespace corotet::benchmarks
