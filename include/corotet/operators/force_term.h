// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

#ifndef corotet_operators_force_term_h
#define corotet_operators_force_term_h

#include <corotet/base/vector.h>

#include <memory>
#include <optional>
#include <string>

namespace corotet
{
  class ForceRoundOff;
  class Obstacle;
  class SurfaceMatrix;

  /**
   * The time and the motion for which forces are asked for.
   */
  struct Motion
  {
    /// Time [s].
    double time;
    /// Displacement [m] and velocity [m/s], with ghosts. The velocity belongs
    /// to this time only if a term says that it depends on it. It is zero in
    /// statics, and may be empty if no term depends on displacement or
    /// velocity.
    const Vector &u;
    const Vector &v;
  };

  /**
   * The force [N] of the ground on a boundary of the body, and its moment about
   * the origin, with current positions [N m].
   */
  struct GroundForce
  {
    unsigned int         boundary;
    dealii::Tensor<1, 3> force;
    dealii::Tensor<1, 3> moment;
  };

  /**
   * A derivative of forces that consists of the body's own matrices: c_K K +
   * c_M M, with the rotations of K frozen.
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
   * and depends_on_time() only. Any other force says so, and whether it is
   * linear, and has its derivative in one of three forms: damping_shares(),
   * add_surface_matrix(), or linearize() with add_linearized(). Preconditioners
   * and assembled matrices include the first two, which stiff forces need.
   * Forces of programs that use the library can have the first and the last
   * form, as the matrix of the surface is not installed: so their stiffness is
   * not included in modes, stable steps and the check of supports in statics,
   * and stiff ones take more iterations. Explicit steps give forces that depend
   * on the velocity, but are neither proportional to the mass nor on the
   * surface, that of half a step before: they are of first order then, and
   * forces that do no work may do some.
   *
   * Forces must be functions of the motion alone, without a memory. They are
   * evaluated in any order, also before a run, at its end time, at
   * displacements that no step has, and again for steps that are repeated. A
   * collective member that throws must do so on all ranks.
   */
  class ForceTerm
  {
  public:
    /// The work of loads and supports is external work, that of damping is
    /// dissipated energy. Elastic forces have an energy() that counts as
    /// elastic energy: their work is not external, but that of a change of
    /// their energy in time is. Static load steps scale loads only.
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
    /// that a step of a linear body takes only one linear solve.
    virtual bool
    is_linear() const
    {
      return !depends_on_displacement() && !depends_on_velocity();
    }

    /// Energy of elastic forces [J]: the force is minus its derivative by the
    /// displacement. Collective.
    virtual double
    energy(const Motion & /*motion*/) const
    {
      return 0;
    }

    /// Adds the force to @p f, in any local entries: the caller compresses the
    /// sum. Collective.
    virtual void
    add_force(Vector &f, const Motion &motion) const = 0;

    /// - df/dv, if it consists of the body's matrices: implicit steps multiply
    /// it by their velocity factor, and the preconditioner includes it.
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

    /// Whether add_surface_matrix() adds a matrix that depends on the motion,
    /// and not only on time. It is no support then, neither in modes nor in
    /// the check of supports in statics.
    virtual bool
    surface_matrix_depends_on_motion() const
    {
      return false;
    }

    /// Adds - (@p c_u df/du + @p c_v df/dv) to @p S, if it is a symmetric,
    /// positive semi-definite matrix of the surface. It is included in steps of
    /// all kinds, preconditioners, stable steps, modes, and the check of
    /// supports in statics. A matrix that depends on the motion may be stiffer,
    /// with the difference in add_linearized(): for dampers it is C in f = - C
    /// (v - v_0), which explicit steps take with the velocity at their end.
    /// Only for elastic terms and dampers. Throws ComputationError. Collective.
    virtual void
    add_surface_matrix(SurfaceMatrix & /*S*/,
                       const Motion & /*motion*/,
                       const double /*c_u*/,
                       const double /*c_v*/) const
    {}

    /// For matrices that depend on the motion: adds one that is no less stiff
    /// than - df/du at any motion.
    virtual void
    add_largest_surface_matrix(SurfaceMatrix & /*S*/) const
    {}

    /// The name of the rigid obstacle that exerts this force, for which the
    /// history has columns; empty for other forces.
    virtual std::string
    obstacle() const
    {
      return "";
    }

    /// This obstacle, to be drawn; none for other forces.
    virtual std::shared_ptr<const Obstacle>
    obstacle_shape() const
    {
      return nullptr;
    }

    /// The boundary on which the ground acts on the body by this force, for
    /// reactions; none for forces that are no support.
    virtual std::optional<unsigned int>
    ground_boundary() const
    {
      return {};
    }

    /// The greatest depth of the body inside of the obstacle [m]; less than
    /// zero where it is outside. Collective.
    virtual double
    depth(const Motion & /*motion*/) const
    {
      return -1;
    }

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
    /// without the parts of damping_shares() and add_surface_matrix(). Ghost
    /// entries of w are up to date. Not collective.
    virtual void
    add_linearized(Vector & /*f*/,
                   const Vector & /*w*/,
                   const double /*velocity_factor*/) const
    {}

    /// Whether this derivative is symmetric. Tangents with frozen rotations
    /// leave out derivatives that are not.
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

    /// The round-off that the force may have [N], as a Euclidean norm; @p size
    /// is that of all loads and supports, @p noise gives that of K v.
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
