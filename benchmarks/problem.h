// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_problem_h
#define corotet_benchmarks_problem_h

#include <corotet/simulation/body.h>

#include <deal.II/base/parameter_handler.h>

#include <array>
#include <memory>
#include <string>

namespace corotet::benchmarks
{
  /// Length, width and height of the beam [m], and its material.
  constexpr double length         = 1;
  constexpr double height         = 0.1;
  constexpr double youngs_modulus = 4e6;
  constexpr double density        = 1000;
  constexpr double standard_fall  = 9.81;

  /**
   * The body of a case, and the label of its benchmarks.
   */
  struct Case
  {
    std::string  label  = "P3/small";
    unsigned int degree = 3;
    /// Cuboids in each direction of the beam, five tetrahedra each.
    std::array<unsigned int, 3> cells = {{24, 3, 3}};
    /// The name of a mesh file or geometry to be used instead of the beam, if
    /// not empty, with elements of size @p element_size [m] if that is not 0.
    std::string mesh;
    double      element_size = 0;
    /// The name of the boundary where x = 0.
    std::string clamped        = "x-min";
    double      poissons_ratio = 0.3;
    /// The stiffness of the half that is not clamped, relative to the clamped
    /// one.
    double jump = 1;
    /// The angle [rad] of the arc to which the beam is bent in the state of
    /// solves.
    double bend = 0;
  };

  /// The mesh of the beam, with vertices inside it and in its sides moved by up
  /// to a tenth of the size of a cuboid, so that no two cells are alike.
  SerialMesh
  beam(const std::array<unsigned int, 3> &cells);

  /// The mesh of a case on rank 0. Region 1 is the half that is not clamped.
  SerialMesh
  serial_mesh(const Case &c);

  /// The period of the first bending mode [s], by Euler-Bernoulli theory.
  double
  first_period();

  /// The input of a body, besides its mesh.
  struct ProblemInput
  {
    /// @p text is that of a parameter file.
    explicit ProblemInput(const std::string &text);

    Log                      log;
    dealii::ParameterHandler prm;
    SimulationParameters     parameters;
    /// Resident memory when only the serial mesh had been made [bytes, of all
    /// ranks].
    double memory_at_start = 0;
  };

  /// The entries for element, material and supports.
  std::string
  body_text(const Case &c);

  /**
   * A cantilever, clamped where x = 0, with everything that linear and
   * corotational operators are made of but no matrix. Rotations are those of
   * the state of solves.
   */
  struct Problem : public ProblemInput, public Body
  {
    explicit Problem(const Case &c);

    Vector
    vector() const;

    /// The displacement of a beam that is bent to an arc of @p angle [rad],
    /// ghosts included.
    Vector
    bent(const double angle) const;

    /// A state in general position, ghosts included: the beam is stretched by
    /// some ten percent, differently in each direction and from place to place,
    /// twisted by two radians and bent to an arc of 1.5.
    Vector
    deformed() const;

    /// The displacement of solves.
    const Vector &
    state_of_solves() const
    {
      return state;
    }

    /// Takes the rotations of the state of solves.
    void
    reset_rotations();

    /// The weight of the beam [N]; zero where it is clamped.
    Vector
    weight() const;

    /// Pseudo-random numbers of size 1, the same on any number of ranks; zero
    /// where the beam is clamped.
    Vector
    random_vector() const;

    void
    clamp(Vector &vector) const;

    /// The same body with another law, so other rotations.
    std::unique_ptr<Elasticity>
    elasticity_with(const std::shared_ptr<const MaterialLaw> &law) const;

    double
    n_unknowns() const
    {
      return 3. * discretization.n_global_nodes();
    }

    /// The displacement of solves, ghosts included.
    Vector state;
  };
} // namespace corotet::benchmarks

#endif
