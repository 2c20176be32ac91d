// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_term_h
#define corotet_operators_force_term_h

#include <corotet/base/vector.h>

namespace corotet
{
  class ForceRoundOff;
  class SurfaceMatrix;

  /**
   * Where and when forces are asked for.
   */
  struct Motion
  {
    /// [s].
    double time;
    /// Displacement [m] and velocity [m/s], with ghosts. The velocity is that
    /// of this time only if a term says that it depends on it, and zero in
    /// statics; if no term depends on displacement or velocity, it may be
    /// empty.
    const Vector &u;
    const Vector &v;
  };

  /**
   * A derivative of forces that consists of the body's own matrices:
   * c_K K + c_M M, with K's rotations frozen.
   */
  struct MatrixShares
  {
    double stiffness = 0;
    double mass      = 0;
  };

  /**
   * A force f(t, u, v) [N] on the body besides that of its elasticity: a load,
   * or a resistance. A term of the equation of motion
   *
   *   M a + f_int(u) = sum of f(t, u, v).
   *
   * A force that depends on neither displacement nor velocity needs add_force()
   * and depends_on_time() only. One that depends on them says so, whether it is
   * linear, and has its derivative, by one of three ways: damping_shares(),
   * add_surface_matrix(), or linearize() with add_linearized(). Preconditioners
   * and assembled matrices have the first two; what is stiff must be there.
   * Forces of programs that use the library have the first and the last one, as
   * the matrix of the surface is not installed: modes, stable steps and what
   * holds a body in statics know nothing of their stiffness, and stiff ones
   * take more iterations.
   *
   * Forces are functions of the motion alone, without a memory. They are asked
   * for in any order, also before a run, at its end time and at displacements
   * that no step has, and of steps that are made again. A collective member
   * that throws must do so on all ranks.
   */
  class ForceTerm
  {
  public:
    /// The work of loads and supports is external work, that of damping is
    /// dissipated energy, and elastic forces are those of an energy() that
    /// counts as elastic energy: what they do is no work from outside, but that
    /// of a change of their energy in time is. Static load steps scale loads
    /// only.
    enum class Role
    {
      load,
      support,
      damping,
      elastic
    };

    virtual ~ForceTerm() = default;

    virtual bool
    depends_on_time() const = 0;

    virtual bool
    depends_on_displacement() const
    {
      return false;
    }

    virtual bool
    depends_on_velocity() const
    {
      return false;
    }

    virtual Role
    role() const
    {
      return Role::load;
    }

    /// Whether the force is linear (or affine) in displacement and velocity, so
    /// that one linear solve is all that a step of a linear body takes.
    virtual bool
    is_linear() const
    {
      return !depends_on_displacement() && !depends_on_velocity();
    }

    /// Of elastic forces [J]: the force is minus its derivative by the
    /// displacement. Collective.
    virtual double
    energy(const Motion & /*motion*/) const
    {
      return 0;
    }

    /// Adds the force to @p f, in any local entries: who calls compresses the
    /// sum. Collective.
    virtual void
    add_force(Vector &f, const Motion &motion) const = 0;

    /// - df/dv, where it consists of the body's matrices: an implicit step
    /// multiplies it by its velocity factor, and the preconditioner has it.
    virtual MatrixShares
    damping_shares() const
    {
      return {};
    }

    /// Whether add_surface_matrix() adds anything.
    virtual bool
    has_surface_matrix() const
    {
      return false;
    }

    /// Adds - (@p c_u df/du + @p c_v df/dv) to @p S, where it is a symmetric,
    /// positive semi-definite matrix of the surface that depends on nothing but
    /// time: in steps of all kinds, preconditioners, stable steps, modes, and
    /// in what holds a body in statics. Forces of elastic terms and of dampers
    /// only. Throws ComputationError. Collective.
    virtual void
    add_surface_matrix(SurfaceMatrix & /*S*/,
                       const double /*time*/,
                       const double /*c_u*/,
                       const double /*c_v*/) const
    {}

    /// Whether add_linearized() has more to add than damping_shares() and
    /// add_surface_matrix().
    virtual bool
    has_linearization() const
    {
      return false;
    }

    /// Prepares add_linearized() at that motion. Not collective.
    virtual void
    linearize(const Motion &)
    {}

    /// Adds (df/du + @p velocity_factor df/dv) w to @p f, in any local entries,
    /// but for damping_shares() and add_surface_matrix(). w's ghosts are up to
    /// date. Not collective.
    virtual void
    add_linearized(Vector & /*f*/,
                   const Vector & /*w*/,
                   const double /*velocity_factor*/) const
    {}

    /// Whether that is symmetric. Frozen tangents have symmetric ones only.
    virtual bool
    is_symmetric() const
    {
      return true;
    }

    /// Whether the force in an implicit step is the gradient of a function of
    /// the displacement: line searches use that.
    virtual bool
    has_potential() const
    {
      return true;
    }

    /// What round-off may make of the force [N], as a Euclidean norm;
    /// @p size is that of all loads and supports, @p noise tells that of K v.
    /// Collective.
    virtual double
    round_off(const Motion & /*motion*/,
              const double /*size*/,
              const ForceRoundOff & /*noise*/) const
    {
      return 0;
    }
  };
} // namespace corotet

#endif
