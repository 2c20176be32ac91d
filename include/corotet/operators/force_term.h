// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_term_h
#define corotet_operators_force_term_h

#include <corotet/base/vector.h>

namespace corotet
{
  class ForceRoundOff;

  /**
   * Where and when forces are asked for.
   */
  struct Motion
  {
    /// [s].
    double time;
    /// Displacement [m] and velocity [m/s]; ghosts up to date.
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
   * and depends_on_time() only.
   */
  class ForceTerm
  {
  public:
    /// The work of loads and supports is external work, that of damping is
    /// dissipated energy. Static load steps scale loads only.
    enum class Role
    {
      load,
      support,
      damping
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

    /// Whether add_linearized() has more to add than damping_shares().
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
    /// but for damping_shares(). w's ghosts are up to date. Not collective.
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
