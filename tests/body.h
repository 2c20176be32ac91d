// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_tests_body_h
#define corotet_tests_body_h

#include <corotet/base/exceptions.h>
#include <corotet/mesh/box_mesh.h>
#include <corotet/simulation/structural_system.h>

#include <deal.II/base/parameter_handler.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <string>

#include "parameter_text.h"

namespace corotet
{
  /// Shows an element in the names of tests: "P2", "P2 with bubbles".
  inline void
  PrintTo(const Element element, std::ostream *stream)
  {
    *stream << 'P' << element.degree()
            << (element.has_bubbles() ? " with bubbles" : "");
  }
} // namespace corotet

namespace corotet::tests
{
  /**
   * The box [0, size] with n cells in each direction (five tetrahedra each).
   * Vertices are moved by up to @p distortion of the cell size, by a fixed rule
   * that keeps those of the surface in their sides.
   */
  inline SerialMesh
  box(const std::string &size,
      const std::string &cells,
      const double       distortion = 0)
  {
    BoxMesh                  source;
    dealii::ParameterHandler prm;
    source.declare_parameters(prm);
    prm.set("Size", size);
    prm.set("Cells", cells);
    SerialMesh       mesh = source.create("");
    dealii::Point<3> upper;
    for (const auto &x : mesh.vertices)
      for (unsigned int a = 0; a < 3; ++a)
        upper[a] = std::max(upper[a], x[a]);
    const double h =
      std::cbrt(upper[0] * upper[1] * upper[2] / (mesh.cells.size() / 5.));
    for (auto &x : mesh.vertices)
      {
        const auto rest = x;
        for (unsigned int a = 0; a < 3; ++a)
          if (rest[a] > 1e-10 && rest[a] < upper[a] - 1e-10)
            x[a] += distortion * h *
                    std::sin(1e3 * (rest[a] + 2 * rest[(a + 1) % 3] +
                                    3 * rest[(a + 2) % 3]) +
                             a);
      }
    return mesh;
  }

  /**
   * Parameters as a .prm file gives them.
   */
  struct Parameters : public SimulationParameters
  {
    explicit Parameters(const std::string &text)
    {
      declare_parameters(prm);
      prm.parse_input_from_string(text);
    }

    dealii::ParameterHandler prm;
  };

  /// The input of a body besides its mesh.
  struct BodyInput
  {
    BodyInput(const std::string &text, const MPI_Comm comm)
      : log(comm, true)
      , parameters(text)
    {}

    Log        log;
    Parameters parameters;
    WallTimes  wall_times;
  };

  /**
   * A body made of a mesh and parameters, with its equation of motion and its
   * initial state, without the driver.
   */
  struct MovingBody : public BodyInput, public corotet::Body
  {
    MovingBody(const SerialMesh  &serial_mesh,
               const std::string &text,
               const MPI_Comm     comm = MPI_COMM_WORLD)
      : BodyInput(text, comm)
      , corotet::Body(parameters, serial_mesh, comm, log)
      , system(*this, parameters, wall_times, log)
    {
      system.initialize(state);
    }

    /// A vector with the values of @p function at all nodes, ghosts included.
    Vector
    interpolate(
      const std::function<dealii::Tensor<1, 3>(const dealii::Point<3> &)>
        &function) const
    {
      Vector u;
      discretization.initialize_vector(u);
      for (unsigned int n = 0; n < discretization.n_owned_nodes(); ++n)
        {
          const auto value = function(discretization.node_position(n));
          for (unsigned int a = 0; a < 3; ++a)
            u.local_element(3 * n + a) = value[a];
        }
      u.update_ghost_values();
      return u;
    }

    StructuralSystem system;
    State            state;
  };

  /// The largest absolute difference of owned entries, over all ranks.
  inline double
  largest_difference(const Vector &u, const Vector &v)
  {
    Vector difference(u);
    difference.set_ghost_state(false);
    for (unsigned int i = 0; i < u.locally_owned_size(); ++i)
      difference.local_element(i) -= v.local_element(i);
    return difference.linfty_norm();
  }

  /// The rotation by @p angle about @p axis (Rodrigues' formula).
  inline dealii::Tensor<2, 3>
  rotation_about(dealii::Tensor<1, 3> axis, const double angle)
  {
    axis /= axis.norm();
    dealii::Tensor<2, 3> R;
    for (unsigned int a = 0; a < 3; ++a)
      for (unsigned int b = 0; b < 3; ++b)
        R[a][b] = (a == b ? 1 : 0) * std::cos(angle) +
                  (1 - std::cos(angle)) * axis[a] * axis[b];
    for (unsigned int a = 0; a < 3; ++a)
      {
        R[(a + 2) % 3][(a + 1) % 3] += std::sin(angle) * axis[a];
        R[(a + 1) % 3][(a + 2) % 3] -= std::sin(angle) * axis[a];
      }
    return R;
  }

  /// Shows a figure that a test has measured, on one rank.
  inline void
  report(const std::string &what, const double figure)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cout << "[ MEASURED ] " << what << ": " << figure << std::endl;
  }
} // namespace corotet::tests

#endif
