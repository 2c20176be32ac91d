// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_benchmarks_problem_h
#define corotet_benchmarks_problem_h

#include <corotet/base/log.h>
#include <corotet/discretization/discretization.h>
#include <corotet/operators/elasticity.h>
#include <corotet/operators/mass.h>

#include <array>
#include <string>

namespace corotet::benchmarks
{
  /// Length, width and height of the beam [m], and its material.
  constexpr double length          = 1;
  constexpr double height          = 0.1;
  constexpr double youngs_modulus  = 4e6;
  constexpr double poissons_ratio  = 0.3;
  constexpr double density         = 1000;
  constexpr double standard_fall   = 9.81;
  constexpr double bent_beam_angle = 1.5;

  /**
   * Which beam: polynomial degree, cuboids in each direction (five tetrahedra
   * each), and the label that its benchmarks are known by.
   */
  struct Case
  {
    std::string                 label  = "P3/small";
    unsigned int                degree = 3;
    std::array<unsigned int, 3> cells  = {{24, 3, 3}};
  };

  /// The mesh of the beam, with vertices inside it and in its sides moved by up
  /// to a tenth of the size of a cuboid, so that no two cells are alike.
  SerialMesh
  beam(const std::array<unsigned int, 3> &cells);

  /// Period of the first bending mode [s], by Euler and Bernoulli.
  double
  first_period();

  /**
   * A cantilever of 10 : 1 : 1, clamped where x = 0, with everything that
   * linear and corotational operators are made of but no matrix.
   */
  struct Problem
  {
    explicit Problem(const Case &c);

    Vector
    vector() const;

    /// The displacement of a beam that is bent to an arc of @p angle [rad],
    /// ghosts included.
    Vector
    bent(const double angle) const;

    /// The weight of the beam [N]; zero where it is clamped.
    Vector
    weight() const;

    /// Pseudo-random numbers of size 1, the same on any number of ranks; zero
    /// where the beam is clamped. Ghosts included.
    Vector
    random_vector() const;

    void
    clamp(Vector &vector) const;

    double
    n_unknowns() const
    {
      return 3. * discretization.n_global_nodes();
    }

    Log                        log;
    Mesh                       mesh;
    Discretization             discretization;
    ReferenceElement           reference;
    Mass                       mass;
    Elasticity                 elasticity;
    std::vector<unsigned char> is_prescribed;
  };
} // namespace corotet::benchmarks

#endif
