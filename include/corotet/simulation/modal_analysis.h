// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_simulation_modal_analysis_h
#define corotet_simulation_modal_analysis_h

#include <corotet/base/log.h>
#include <corotet/discretization/rigid_motions.h>
#include <corotet/simulation/body.h>
#include <corotet/solvers/eigenvalue_solver.h>

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace corotet
{
  /**
   * A mode of vibration: K phi = omega^2 M phi.
   */
  struct Mode
  {
    /// omega^2 [1/s^2], not negative.
    double eigenvalue;
    /// omega [rad/s].
    double angular_frequency;
    /// In Hz.
    double frequency;
    /// |K phi - omega^2 M phi| / (max(omega^2, omega_1^2) |M phi|) with the
    /// lowest omega_1 that is not zero, to which it is relative for rigid body
    /// modes.
    double residual;
    /// Largest residual that round-off explains, with these units.
    double round_off;
    /// phi . M phi [kg m^2].
    double modal_mass;
    /// (phi . M e)^2 / (phi . M phi) for the unit translation e in x, y and z
    /// [kg].
    dealii::Tensor<1, 3> effective_mass;
    /// phi [m], ghost entries up to date.
    Vector shape;
  };

  /**
   * The lowest modes of small vibrations of the body about its state at rest,
   * with linear elasticity: K phi = omega^2 M phi, phi = 0 where the
   * displacement is prescribed. K has the springs of elastic supports, at the
   * start time. Loads, damping and values of prescribed displacements play no
   * part.
   *
   * The constructor makes and checks everything that the parameters describe;
   * compute() computes. @p parameters, which have been read already, and @p
   * log must outlive this object. Members are collective.
   */
  class ModalAnalysis
  {
  public:
    /// @p folder: of the parameter file, for relative names of mesh files.
    /// Throws InputError.
    ModalAnalysis(const SimulationParameters &parameters,
                  const std::string          &folder,
                  const MPI_Comm              comm,
                  Log                        &log);

    const Body &
    body() const
    {
      return the_body;
    }

    /**
     * Computes the modes. Throws ComputationError if not all of them are found,
     * or the residual of one is too large; those that are there can be had all
     * the same.
     */
    void
    compute();

    /// Those computed, lowest first. Shapes are scaled such that the largest
    /// displacement of a node is a hundredth of the body's length, the diagonal
    /// of its bounding box. Of a mode with a frequency of its own, the sign is
    /// the same on any number of ranks, and that of a rigid body mode is, too.
    const std::vector<Mode> &
    modes() const
    {
      return computed;
    }

    unsigned int
    n_linear_iterations() const
    {
      return solver.n_linear_iterations();
    }

    /// What is known of the run at its end. The number of steps is that of the
    /// modes.
    RunSummary
    summary() const;

    /// Time for the results is to be added by who writes them.
    WallTimes wall_times;

  private:
    void
    note_what_is_ignored() const;
    /// Below the lowest eigenvalue of most bodies.
    double
    estimated_shift() const;
    /// By a first look at the lowest mode that deforms the body.
    void
    choose_shift();
    /// Throws InputError if the shift is beyond all modes. Collective.
    void
    check_shift() const;
    Mode
    make_mode(const Vector &x) const;
    /// 1 or -1, to multiply x with.
    double
    sign(const Vector &x) const;
    /// Says so if modes that are missing have the frequency of the last one.
    /// @p eigenvalues: of all that are known, in ascending order.
    void
    note_cut_group(const std::vector<double> &eigenvalues) const;
    void
    check(const Mode &mode, const unsigned int number) const;
    void
    log_table() const;
    double
    seconds() const;

    const std::chrono::steady_clock::time_point started =
      std::chrono::steady_clock::now();

    const SimulationParameters &parameters;
    Log                        &log;
    Body                        the_body;
    const ForceTerms            terms;
    /// The terms' matrix of the surface; null if they have none.
    const std::unique_ptr<const SurfaceMatrix> surface;
    const RigidMotions                         rigid_motions;
    EffectiveOperator                          A;
    LinearSolver                               linear_solver;
    EigenvalueSolver                           solver;
    /// Lower and upper corner of the body's bounding box, and its diagonal.
    const std::pair<dealii::Point<3>, dealii::Point<3>> box;
    const double                                        length;

    double shift = 0;
    /// omega^2 of the lowest mode that deforms the body.
    double            lowest = 0;
    std::vector<Mode> computed;
  };
} // namespace corotet

#endif
