// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_step_record_h
#define corotet_simulation_step_record_h

#include <corotet/base/archive.h>
#include <corotet/operators/force_term.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * The force of a support on the body along one unknown.
   */
  struct SupportForce
  {
    /// Force [N].
    double force = 0;
    /// Position of the unknown's node [m].
    dealii::Tensor<1, 3> position;
  };

  /**
   * The budget of one step, equal on all ranks. Units: SI.
   */
  struct StepRecord
  {
    unsigned int step              = 0;
    double       time              = 0;
    double       dt                = 0;
    unsigned int newton_iterations = 0;
    unsigned int linear_iterations = 0;

    double kinetic_energy    = 0;
    double elastic_energy    = 0;
    double dissipated_energy = 0;
    double external_work     = 0;
    /// Kinetic + elastic + dissipated energy - external work, less its value at
    /// the start: the error of the balance.
    double energy_balance = 0;

    dealii::Tensor<1, 3> momentum;
    /// Angular momentum about the origin, with current positions.
    dealii::Tensor<1, 3> angular_momentum;

    double       max_displacement = 0;
    double       min_det_F        = 1;
    unsigned int inverted_cells   = 0;
    unsigned int degenerate_cells = 0;
    /// Cells whose rotation the fast algorithm left to the robust one.
    unsigned int robust_rotations = 0;
    /// The largest number of cells, over the tangents since the last record,
    /// where the derivative of a rotation was clamped.
    unsigned int clamped_cells = 0;
    /// Number of parts that the step was made in: 1 unless it failed at first.
    unsigned int parts = 1;
    /// Number of steps up to now that were too inaccurate and were repeated.
    unsigned int rejected_steps = 0;
    /// Wall time since the start of the run [s].
    double wall_time = 0;

    /// Volume of the deformed body [m^3].
    double volume = 0;
    /// Sum of the forces that the supports exert on the body [N].
    dealii::Tensor<1, 3> reaction;
    /// Moment of the internal forces about the origin, with current positions
    /// [N m]: zero for a law that conserves angular momentum.
    dealii::Tensor<1, 3> internal_moment;

    /// Energy of the pressure of obstacles, a part of the elastic energy [J].
    double contact_energy = 0;
    /// What friction has taken of the dissipated energy [J].
    double friction_work = 0;
    /// The names of obstacles, and their forces on the body [N].
    std::vector<std::pair<std::string, dealii::Tensor<1, 3>>> contact_forces;
    /// What springs and dashpots do, by boundary.
    std::vector<GroundForce> ground_forces;

    /// Transfers all members.
    void
    transfer(Archive &archive);

  private:
    void
    transfer_contact_forces(Archive &archive);
    void
    transfer_ground_forces(Archive &archive);
  };
} // namespace corotet

#endif
