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
    /// Frequency [Hz].
    double frequency;
    /// |K phi - omega^2 M phi| / (max(omega^2, omega_1^2) |M phi|) with the
    /// lowest omega_1 that is not zero, the reference for rigid body modes.
    double residual;
    /// The largest residual that round-off can explain, in the same units.
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
    /// @p folder is that of the parameter file; relative names of mesh files
    /// begin there. Throws InputError.
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

    /// The computed modes, lowest first. Shapes are scaled such that the
    /// largest displacement of a node is a hundredth of the body's length, the
    /// diagonal of its bounding box. The sign of a mode that shares its
    /// frequency with no other is the same on any number of ranks, as is that
    /// of a rigid body mode.
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

    /// The summary of the run at its end. Its number of steps is that of the
    /// modes.
    RunSummary
    summary() const;

    /// Wall times; whoever writes results adds the time for that.
    WallTimes wall_times;

  private:
    void
    note_what_is_ignored() const;
    /// A shift below the lowest eigenvalue of most bodies.
    double
    estimated_shift() const;
    /// Chooses the shift by an estimate for the lowest mode that deforms the
    /// body.
    void
    choose_shift();
    /// Finds the eigenpairs with the shift. Throws ComputationError, which
    /// names a given shift that is too small. Collective.
    Eigenpairs
    solve();
    /// Throws InputError if the shift is beyond all modes. Collective.
    void
    check_shift() const;
    Mode
    make_mode(const Vector &x) const;
    /// 1 or -1, the factor that gives x a definite sign.
    double
    sign(const Vector &x) const;
    /// Logs if modes that are missing have the frequency of the last one. @p
    /// eigenvalues are all that are known, in ascending order.
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
    /// The surface matrix of the force terms; null if they have none.
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
